// SPDX-License-Identifier: MIT
#include "run/energy_advice.hpp"

#include "model/model.hpp"

namespace tribo {

std::string cure_of_gain(const Scheme& s) {
  const bool apic = s.transfer == Transfer::apic;
  const bool splines = s.kernel == Kernel::quadratic_spline || s.kernel == Kernel::cubic_spline;
  std::string often;
  const auto add = [&](bool wanted, const char* what) {
    if (wanted) often += (often.empty() ? "" : ", ") + std::string(what);
  };
  add(!apic, "<Transfer type='APIC'/>");
  add(s.extrapolate_again || s.order == UpdateOrder::usf, "<SkipPostExtrapolation/> (USL-, USAVG-)");
  add(!splines, "<GIMP type='quadratic'/>");
  return often.empty() ? "a smaller <TimeFactor>" : "often avoided by " + often + " or a smaller <TimeFactor>";
}

std::string cure_of_loss(const Model& model, const std::string& loss) {
  const Scheme& s = model.scheme;
  const bool filtered = s.transfer == Transfer::fmpm || s.transfer == Transfer::xpic;
  if (s.order == UpdateOrder::usf && s.transfer != Transfer::flip)
    return "with USF " + loss +
           " is what the transfer dissipates, which USL and USAVG give apart; the motion is the same";
  if (s.extrapolate_again || s.order == UpdateOrder::usf || filtered) return "";
  const bool apic_too = s.transfer == Transfer::flip && model.seeks_equilibrium();
  if (s.order == UpdateOrder::usl)
    return std::string(apic_too ? "USAVG- or <Transfer type='APIC'/>" : "USAVG-") + " usually avoids most of " + loss;
  if (!model.seeks_equilibrium())
    return "the update without <SkipPostExtrapolation/> (USAVG+) usually avoids most of " + loss;
  return "";
}

std::string cure_of_excess(const Scheme& s) {
  const bool averaged = s.order == UpdateOrder::usavg && !s.extrapolate_again;
  return std::string(averaged ? "a smaller <TimeFactor> usually reduces it"
                              : "USAVG- or a smaller <TimeFactor> usually reduces it");
}

}  // namespace tribo
