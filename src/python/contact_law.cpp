// SPDX-License-Identifier: MIT
/// Contact laws that are written in Python. The solver asks for the impulse of one pair at a time.

#include "contact/contact_law.hpp"

#include "base/error.hpp"
#include "contact/own_law.hpp"
#include "python/own_law.hpp"

#include <pybind11/eigen.h>

namespace tribo::python {
namespace {

class PythonContact final : public ContactLaw {
 public:
  PythonContact(Held law, std::string name) : law_(std::move(law)), name_(std::move(name)) {
    uses_face_ = (*law_).attr("uses_face").cast<bool>();
    uses_area_ = (*law_).attr("uses_area").cast<bool>();
    has_memory_ = (*law_).attr("has_memory").cast<bool>();
    needs_closed_faces_ = (*law_).attr("needs_closed_faces").cast<bool>();
  }

  ContactResponse response(const ContactState& state) const override {
    const py::gil_scoped_acquire interpreter;
    const py::object given = (*law_).attr("response")(py::cast(state, py::return_value_policy::copy));
    const ContactResponse response = response_of(state, given);
    if (!response.impulse.allFinite() && state.velocity.allFinite())
      throw SimulationError("response() of '" + name_ + "' gave an impulse that is not finite");
    return response;
  }
  bool uses_face() const override { return uses_face_; }
  bool has_memory() const override { return has_memory_; }
  bool needs_closed_faces() const override { return needs_closed_faces_; }
  bool uses_area() const override { return uses_area_; }

 private:
  ContactResponse response_of(const ContactState& state, const py::object& given) const {
    if (py::isinstance<ContactResponse>(given)) return given.cast<ContactResponse>();
    if (given.is_none()) return response_with(state, Vec3::Zero());
    const py::object fitted =
        py::module_::import("tribo._arrays").attr("fit_impulse")(given, "response() of '" + name_ + "'");
    return response_with(state, fitted.cast<Vec3>());
  }

  Held law_;
  std::string name_;
  bool uses_face_ = true, uses_area_ = false, has_memory_ = false, needs_closed_faces_ = false;
};

void add_state(py::module_& module) {
  py::enum_<Bond>(module, "Bond").value("none", Bond::none).value("whole", Bond::whole).value("broken", Bond::broken);
  py::enum_<ContactStatus>(module, "ContactStatus")
      .value("open", ContactStatus::open)
      .value("stick", ContactStatus::stick)
      .value("slip", ContactStatus::slip);
  py::class_<NormalContact>(module, "NormalContact", "The normal impulse of a pair, and its tangential motion.")
      .def_readonly("normal", &NormalContact::normal, "J . n [mass velocity]; 0 if open")
      .def_readonly("closed", &NormalContact::closed, "whether the faces are in contact")
      .def_property_readonly("direction", &NormalContact::direction, "unit vector of the sliding; zero without sliding")
      .def_readonly("stick", &NormalContact::stick, "impulse along `direction` that stops the sliding")
      .def_property_readonly("pressure", &NormalContact::pressure, "compressive impulse N A dt >= 0");
  py::class_<ContactResponse>(module, "ContactResponse", "The impulse on a, and what the faces do.")
      .def(py::init([](const Vec3& impulse, ContactStatus status, Bond bond) {
             return ContactResponse{impulse, status, bond};
           }),
           py::arg("impulse"), py::arg("status"), py::arg("bond") = Bond::none)
      .def_readwrite("impulse", &ContactResponse::impulse)
      .def_readwrite("status", &ContactResponse::status)
      .def_readwrite("bond", &ContactResponse::bond);
  const auto state = py::class_<ContactState>(module, "ContactState", "A pair of faces at a node, in one step.");
  auto adds = state;
  adds.def(py::init<>())
      .def_readwrite("mass", &ContactState::mass, "reduced mass [mass]")
      .def_readwrite("dt", &ContactState::dt, "step [time]")
      .def_readwrite("area", &ContactState::area, "share of the node in the contact area; with `uses_area` only")
      .def_readwrite("gap", &ContactState::gap, "between the faces at the start of the step; negative: overlap")
      .def_readwrite("normal", &ContactState::normal, "unit normal from a to b")
      .def_readwrite("velocity", &ContactState::velocity, "of b relative to a at the end, without the impulse")
      .def_readwrite("start", &ContactState::start, "the same at the start of the step")
      .def_readwrite("slip", &ContactState::slip, "sliding since the faces last stuck; with `has_memory` only")
      .def_readwrite("cell", &ContactState::cell, "cell size of the grid [length]")
      .def_readwrite("bond", &ContactState::bond)
      .def("normal_contact", &rigid_contact_of, "the normal impulse by Signorini's condition, as a NormalContact")
      .def("frictional", &sliding_beyond, py::arg("limit"),
           "the response of faces that slide once the tangential impulse reaches `limit`");
}

}  // namespace

void add_contact_laws(py::module_& module) {
  add_state(module);
  module.def("add_contact_law", [](const std::string& name, const std::string& summary, const py::list& parameters,
                                   const py::object& make) {
    extensible_contact_laws().add(own_law<ContactLaw, PythonContact>(name, summary, parameters, make));
  });
}

}  // namespace tribo::python
