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
  if (!model.seeks_equilibrium())
    return "the update without <SkipPostExtrapolation/> (USL+, USAVG+) usually avoids most of " + loss;
  if (s.order == UpdateOrder::usl && s.transfer == Transfer::flip)
    return "USAVG- or <Transfer type='APIC'/> usually avoids most of " + loss;
  return "";
}

}  // namespace tribo
