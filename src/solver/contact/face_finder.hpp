// SPDX-License-Identifier: MIT
/// The common face of two fields at a node: normal, gap, area and position.
#pragma once

#include "solver/contact/contact_laws.hpp"
#include "solver/contact/face_cache.hpp"
#include "solver/contact/normal_finder.hpp"

namespace tribo {

/// Finds faces from the particles around contact nodes. It depends on the present positions only, not on earlier steps.
template <int Dim>
class FaceFinder {
 public:
  /// `cloud`: the particles around the contact nodes.
  FaceFinder(const Model& model, const System<Dim>& system, const ParticleCloud<Dim>& cloud,
             const ContactLaws<Dim>& laws);

  /// Finds the face of a pair of two bodies: fills normal, gap, area and face position of `pair`, and what `face` keeps
  /// of them. The volumes of the two fields at the node (NodalVolumes) must be up to date. `members`: of all contact
  /// nodes. False if there is no common face, or if the law does not need one. `near`: working memory; then holds the
  /// particles around the node.
  bool find(const ContactNode<Dim>& node, std::span<const ContactMember> members, ContactPair& pair, ContactFace& face,
            NearParticles<Dim>& near) const;

 private:
  double gap_between_sides(const ContactNode<Dim>& node, const ContactMember& a, const ContactMember& b,
                           NearParticles<Dim>& near, const Vec<Dim>& n) const;
  double area(const ContactNode<Dim>& node, const ContactMember& a, const ContactMember& b, NearParticles<Dim>& near,
              const Vec<Dim>& n) const;
  bool is_thin(const ContactNode<Dim>& node, NearParticles<Dim>& near, std::size_t side, const Vec<Dim>& out) const;
  double offset_along_face(NearParticles<Dim>& near, const Vec<Dim>& n) const;

  const Model& model_;
  const System<Dim>& system_;
  const ParticleCloud<Dim>& cloud_;
  NormalFinder<Dim> normals_;
  bool needs_areas_;
  double h_;  // cell size [length]
};

}  // namespace tribo
