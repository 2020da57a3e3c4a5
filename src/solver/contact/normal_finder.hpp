// SPDX-License-Identifier: MIT
/// The contact normal between two fields at a node.
#pragma once

#include "solver/contact/contact_nodes.hpp"
#include "solver/contact/near_particles.hpp"

#include <optional>

namespace tribo {

/// Finds contact normals by the method of the model (NormalMethod), and the particles that determine the faces.
template <int Dim>
class NormalFinder {
 public:
  /// `cloud`: the particles around the contact nodes; it may be collected anew between calls.
  NormalFinder(const ContactSpec& spec, const System<Dim>& system, const ParticleCloud<Dim>& cloud)
      : spec_(spec), system_(system), cloud_(cloud), h_(system.lattice.spacing.maxCoeff()) {
    for (const auto* list : {&system.bodies, &system.rigids})
      for (const Body<Dim>& body : *list) has_cut_cells_ = has_cut_cells_ || body.half_axes;
  }

  /// Unit normal from field a to field b at a node; std::nullopt if the two have no common face there. Fills `near`
  /// with the particles that determine the normal and the gap. Methods based on volume gradients read
  /// ContactMember::volumes.
  std::optional<Vec<Dim>> find(const ContactNode<Dim>& node, const ContactMember& a, const ContactMember& b,
                               NearParticles<Dim>& near) const;

 private:
  using Groups = typename NearParticles<Dim>::Groups;
  // The normal of largest margin between the foremost particles of both sides.
  struct FrontNormal {
    std::optional<Vec<Dim>> normal;
    bool same_normal = false;  // all particles together have this normal, too
    bool same_gap = false;     // and the gap that the foremost particles have
  };

  Vec<Dim> gradient_normal(const ContactMember& a, const ContactMember& b) const;
  void collect_groups(const ContactNode<Dim>& node, NearParticles<Dim>& near, const ContactMember& a,
                      const ContactMember& b) const;
  void fill_sides(const Vec<Dim>& centre, NearParticles<Dim>& near) const;
  void add_band_particles(const Vec<Dim>& centre, NearParticles<Dim>& near, const Vec<Dim>& n, double depth) const;
  static std::size_t remove_behind(NearParticles<Dim>& near, std::size_t begin, std::size_t end, double limit);
  void fill_foremost(const Vec<Dim>& centre, NearParticles<Dim>& near, std::size_t side, const Vec<Dim>& out) const;
  bool is_complete(const Vec<Dim>& centre, NearParticles<Dim>& near, std::size_t side, const Vec<Dim>& guess,
                   const Vec<Dim>& out, double limit) const;
  FrontNormal front_normal(const Vec<Dim>& centre, NearParticles<Dim>& near, const Vec<Dim>& guess) const;
  std::optional<Vec<Dim>> normal_of_smooth_faces(NearParticles<Dim>& near, const Vec<Dim>& n) const;
  Vec<Dim> normal_of_faces(NearParticles<Dim>& near, const Vec<Dim>& n) const;
  std::optional<Vec<Dim>> largest_margin(const Vec<Dim>& centre, NearParticles<Dim>& near,
                                         const Vec<Dim>& gradient) const;
  std::optional<Vec<Dim>> normal_within_reach(const Vec<Dim>& centre, NearParticles<Dim>& near,
                                              const Vec<Dim>& guess) const;
  std::optional<Vec<Dim>> chosen_normal(const ContactNode<Dim>& node, NearParticles<Dim>& near, const ContactMember& a,
                                        const ContactMember& b) const;

  const ContactSpec& spec_;
  const System<Dim>& system_;
  const ParticleCloud<Dim>& cloud_;
  double h_;                    // cell size [length]
  bool has_cut_cells_ = false;  // some particles have domains that are not along the grid axes at the start
};

}  // namespace tribo
