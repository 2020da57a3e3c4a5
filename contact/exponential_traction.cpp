// SPDX-License-Identifier: MIT
/// Traction that grows linearly up to a peak and then falls to zero like an exponential, in each mode:
///   T = sigma (e^(-alpha x) - e^-alpha)/(1 - e^-alpha),  x = (d - d_peak)/(delta_c - d_peak)

#include "contact/cohesive_properties.hpp"

namespace tribo {
namespace {

struct ExponentialTraction final : CohesiveProperties {
  static constexpr std::string_view name = "ExponentialTraction";
  static constexpr std::string_view summary =
      "Cohesive zone whose traction rises to a peak and then decays exponentially to zero.";
  static constexpr int number = 34;
  static constexpr std::string_view needs =
      "for opening, alphaI; two of sigmaI, JIc and delIc with kIe or delpkI, or one of these three with both kIe and "
      "delpkI. For sliding the same of alphaII, sigmaII, JIIc, delIIc, kIIe and delpkII";
  static constexpr std::string_view example = R"(
<Material Type='ExponentialTraction' Name='glue'>
  <sigmaI>2e6</sigmaI>
  <JIc>100</JIc>
  <delpkI>0.1</delpkI>
  <sigmaII>3e6</sigmaII>
  <JIIc>200</JIIc>
  <delpkII>0.1</delpkII>
  <alphaI>4</alphaI>
  <alphaII>4</alphaII>
</Material>)";

  static auto parameters() {
    using Rows = CohesiveRows<ExponentialTraction>;
    return Rows::join(Rows::peaks(), Rows::energies(), Rows::ends(), Rows::slopes(), Rows::places(), Rows::decays(),
                      Rows::mixture(), Rows::closed());
  }
  void prepare(const Statement& s, Problems& problems) { make_curves(s, problems, exponential_from); }
};

}  // namespace

Catalogue<JointLaw>::Item exponential_traction() {
  return catalogue_item<JointLaw, ExponentialTraction, ExponentialTraction>({});
}

}  // namespace tribo
