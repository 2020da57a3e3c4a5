// SPDX-License-Identifier: MIT
/// Keywords of contact.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_contact(Rows& add) {
  add({"MultiMaterialMode",
       "MPMHeader",
       "each material has its own velocity field; materials interact by contact laws",
       T::none,
       {{"Normals", T::choice,
         "method for contact normals (default margin): 0 larger gradient, 1 larger volume, 2 average gradient, 3 "
         "gradient of the first body, 4 specified, 5 linear regression, 6 logistic regression, 7 largest margin",
         "0 1 2 3 4 5 6 7 maxgrad maxvol avggrad owngrad specify linreg logreg margin"},
        {"Separation", T::choice,
         "method for gaps (default: edges of the particle domains; with gradient normals: positions if ContactPosition "
         "is "
         "given, else displacements)",
         "edges positions displacements"},
        {"Impulses", T::choice,
         "where the contact conditions hold: at nodes is robust in any motion; at faces gives the correct stress in "
         "the cells next to the contact, without numerical damping, at a higher cost. Default: faces if a deformable "
         "body that touches another one at the start is at most three cells thick there or lies between rigid faces on "
         "opposite sides, else nodes",
         "nodes faces"},
        number("RigidBias",
               "weight of the volume gradient of a rigid body (default 1); acts only where no plane separates the body "
               "from the other one"),
        number("Azimuth", "azimuth of a specified normal, from x [degrees]"),
        number("Polar", "polar angle of a specified normal, from z [degrees]"),
        text("Lumping", "obsolete, without effect: all pairs at a node are solved together"),
        text("Vmin", "obsolete, without effect"),
        text("Dcheck", "obsolete, without effect")},
       true});
  add({"Friction", "MultiMaterialMode",
       "the default contact law; or in the old form a number: -10 or less IgnoreContact, negative stick, below 10 "
       "friction coefficient, else an interface (absent: frictionless)",
       T::number, contact_law(), true});
  add({"Friction", "Material",
       "law between this material and another: a contact law, or a joint law, which acts where their faces touch at "
       "the "
       "start",
       T::number,
       contact_law() +
           std::vector<AttributeSpec>{text("mat", "number of the other material; this or matname is required"),
                                      text("matname", "name of the other material; this or mat is required")}});
  add({"ContactPosition",
       "MultiMaterialMode",
       "for gaps from positions and normals from gradients: distance in cells at which bodies touch, or minus an "
       "exponent",
       T::number,
       {},
       true});
  add({"ContactPosition",
       "Cracks",
       "accepted without effect: gaps of cracks follow from the displacements of their faces",
       T::number,
       {},
       true});
}

void add_shared_fields(Rows& add) {
  add({"shareMatField",
       "Material",
       "number of the material whose velocity field this one shares",
       T::integer,
       {},
       true});
}

}  // namespace tribo::keywords
