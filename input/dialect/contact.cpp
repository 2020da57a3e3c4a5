// SPDX-License-Identifier: MIT
/// Keywords of contact.

#include "input/dialect/rows.hpp"

namespace tribo::keywords {

void add_contact(Rows& add) {
  add({"MultiMaterialMode",
       "MPMHeader",
       "each material has its own velocity field, and materials interact by contact laws. Without this element, "
       "materials that meet stick together",
       T::none,
       {{"Normals", T::choice,
         "method for contact normals, by number or name: 0 maxgrad, the larger gradient; 1 maxvol, the gradient of the "
         "larger volume; 2 avggrad, the average gradient; 3 owngrad, the gradient of the first body; 4 specify, given "
         "by Azimuth and Polar; 5 linreg, linear regression; 6 logreg, logistic regression; 7 margin (default), the "
         "largest margin",
         "0 1 2 3 4 5 6 7 maxgrad maxvol avggrad owngrad specify linreg logreg margin"},
        {"Separation", T::choice,
         "method for gaps: from the edges of the particle domains (default), from positions or from displacements at "
         "the nodes. If Normals is 0 to 4, the default is positions with <ContactPosition> and displacements without "
         "it",
         "edges positions displacements"},
        {"Impulses", T::choice,
         "where the contact conditions hold. faces: gives the correct stress in the cells next to the contact, without "
         "numerical damping, at a higher cost. nodes: faster, with damping. Default: faces if a body in contact is "
         "thin, curved or inelastic or lies between rigid faces, or with splines; nodes otherwise, with more than 16 "
         "deformable materials, with films of liquid, and in models with cracks, joints, rigid blocks, interface laws, "
         "Normals or Separation",
         "nodes faces"},
        number("RigidBias",
               "weight, > 0, of the volume gradient of a rigid body (default 1); it acts only where no plane separates "
               "the body from the other one"),
        number("Azimuth", "angle of a specified normal from the x axis [degrees]; required with Normals='specify'"),
        number("Polar", "angle of a specified normal from the z axis [degrees] (default 90)"),
        text("Lumping", "accepted without effect, since all pairs at a node are solved together"),
        text("Vmin", "accepted without effect"),
        text("Dcheck", "accepted without effect")},
       true});
  add({"Friction", "MultiMaterialMode",
       "the default contact law. In the old form the text is a number: -10 or less means no contact (IgnoreContact), "
       "another negative number no sliding, a number below 10 is a friction coefficient, and any other number means an "
       "interface. Without this element contact is frictionless",
       T::number, contact_law(), true});
  add({"Friction", "Material",
       "law between this material and another one. A contact law acts wherever they meet, a joint law where their "
       "faces touch at the start. If the other material is the material itself, the contact law acts between its "
       "bodies: each shape of a Body then has a velocity field of its own",
       T::number,
       contact_law() +
           std::vector<AttributeSpec>{text("mat", "number of the other material; this or matname is required"),
                                      text("matname", "name of the other material; this or mat is required")}});
  add({"ContactPosition",
       "MultiMaterialMode",
       "for gaps from positions with normals from gradients: distance of the bodies in cells at which they touch, or "
       "minus the exponent of a power law for this distance",
       T::number,
       {},
       true});
  add({"ContactPosition",
       "Cracks",
       "accepted without effect, since gaps of cracks follow from the displacements of their faces",
       T::number,
       {},
       true});
}

void add_shared_fields(Rows& add) {
  add({"shareMatField",
       "Material",
       "number of the material whose velocity field this material shares, so that the two stick together",
       T::integer,
       {},
       true});
}

}  // namespace tribo::keywords
