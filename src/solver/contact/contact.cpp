// SPDX-License-Identifier: MIT
#include "solver/contact/contact.hpp"

#include "base/parallel.hpp"
#include "base/ranks.hpp"
#include "grid/kernels.hpp"
#include "solver/contact/contact_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribo {
namespace {

// Particles at most this far from a node determine its faces [cells].
double particle_reach(Kernel kernel) { return reach_of(kernel) + 1.0; }

bool keeps_start_impulses(Transfer transfer) {
  return transfer == Transfer::flip || transfer == Transfer::blend || transfer == Transfer::xpic;
}

template <int Dim>
std::vector<Body<Dim>*> bodies_with_field(System<Dim>& system) {
  std::vector<Body<Dim>*> bodies;
  for (auto* list : {&system.bodies, &system.rigids})
    for (auto& body : *list)
      if (body.field < system.fields.size()) bodies.push_back(&body);
  return bodies;
}

// Laws that read slip or bonds need all particles near the node in every step.
template <int Dim>
bool can_keep_faces(const Model& model, const ContactLaws<Dim>& laws) {
  return !laws.any_has_memory() && model.contact.separation == Separation::edges;
}

}  // namespace

template <int Dim>
Contact<Dim>::Contact(const Model& model, System<Dim>& system, const Transfers<Dim>& transfers, Cracks<Dim>& cracks)
    : model_(model),
      system_(system),
      cracks_(cracks),
      laws_(model, system),
      active_(system.fields.size() > 1),
      keeps_start_impulses_(active_ && tribo::keeps_start_impulses(model.scheme.transfer)),
      start_pass_(model.scheme.transfer == Transfer::xpic ? Pass::predictor : Pass::held),
      bodies_(bodies_with_field(system)),
      planes_(model.grid, system.lattice),
      cloud_(system.lattice, particle_reach(model.scheme.kernel) * system.lattice.spacing.maxCoeff(), planes_),
      search_(system, laws_),
      volumes_(system, transfers),
      finder_(model, system, cloud_, laws_),
      cache_(system, active_ && can_keep_faces(model, laws_), planes_),
      node_impulses_(system, search_.found()),
      face_solver_(system),
      memory_(system, search_, cloud_, bodies_),
      ledger_(system),
      h_(system.lattice.spacing.maxCoeff()) {}

template <int Dim>
void Contact<Dim>::locate() {
  if (!active_) return;
  search_.locate();
  cache_.clear();
}

template <int Dim>
void Contact<Dim>::find(const Exchanges<Dim>& exchanges, const Joints<Dim>& joints) {
  if (!active_) return;
  const auto lap = watch.lap();
  search_.find(exchanges);
  find_crack_faces();
  if (cache_.reuse(search_.found(), bodies_)) find_faces(exchanges);
  leave_to_joints(joints);
  if (system_.contact_at_faces) face_solver_.set_up(search_.found(), exchanges);
}

// Fills the pairs of crack faces with the laws and states of their cracks.
template <int Dim>
void Contact<Dim>::find_crack_faces() {
  if (!cracks_.active()) return;
  cracks_.integrate_faces();
  auto& contacts = search_.found();
  parallel_for(static_cast<std::ptrdiff_t>(contacts.nodes.size()), [&](std::ptrdiff_t k) {
    const ContactNode<Dim>& node = contacts.nodes[static_cast<std::size_t>(k)];
    for (ContactPair& pair : contacts.pairs_of(node)) {
      if (pair.crack < 0) continue;
      const auto side = [&](std::size_t member) { return system_.fields[contacts.members[member].field].side; };
      pair.has_no_face = !cracks_.find_faces(pair, node.index, side(pair.a), side(pair.b));
      for (int d = 0; d < Dim; ++d)
        if (node.mirrored_axes >> d & 1) pair.state.normal[d] = 0.0;
      pair.has_no_face = pair.has_no_face || !(pair.state.normal.norm() > 1e-6);
      if (!pair.has_no_face) pair.state.normal.normalize();
    }
  });
}

// Finds the faces of the pairs that have none, or whose kept faces are no longer valid.
template <int Dim>
void Contact<Dim>::find_faces(const Exchanges<Dim>& exchanges) {
  auto& contacts = search_.found();
  collect_particles();
  volumes_.scatter(contacts, bodies_, exchanges);
  if (near_.size() < static_cast<std::size_t>(threads())) near_.resize(static_cast<std::size_t>(threads()));
  searched_.clear();
  for (std::size_t k = 0; k < contacts.nodes.size(); ++k)
    if (contacts.nodes[k].needs_faces) searched_.push_back(k);
  // Faces differ in cost by ten times, so that threads which have finished take over nodes of others.
  const auto before = [](std::ptrdiff_t k) { return k; };
  parallel_for_weighted(static_cast<std::ptrdiff_t>(searched_.size()), before, [&](std::ptrdiff_t k) {
    const ContactNode<Dim>& node = contacts.nodes[searched_[static_cast<std::size_t>(k)]];
    NearParticles<Dim>& near = near_[static_cast<std::size_t>(thread_index())];
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      ContactPair& pair = contacts.pairs[p];
      if (!pair.needs_face) continue;
      ContactFace& face = cache_.new_face(p);
      if (!finder_.find(node, contacts.members, pair, face, near)) {
        if (face.missing) cache_.store_missing(face, near.apart);
        continue;
      }
      if (cache_.enabled()) cache_.store(face, pair, near);
      if (pair.law->has_memory()) memory_.read(node, pair, near);
    }
  });
  cache_.end_search(cloud_);
}

// Collects the particles around the nodes whose faces must be found, at their present positions.
template <int Dim>
void Contact<Dim>::collect_particles() {
  cloud_.clear();
  for (const auto& node : search_.found().nodes)
    if (node.needs_faces) cloud_.request(node.index);
  cloud_.collect(bodies_);
}

// A joint between two bodies replaces the contact law at all nodes that its points act on. Exception: where the common
// face continues by more than a cell beyond the last joint, the contact law acts. There the normal of the face must be
// nearly that of the joint: two bodies that also approach each other beyond the end of their common face have another
// normal, and joint and face are about equally far from the node.
template <int Dim>
void Contact<Dim>::leave_to_joints(const Joints<Dim>& joints) {
  if (model_.contact.joints.empty()) return;
  constexpr double min_cosine = 0.866;  // between the normals of the joint and of the face
  auto& contacts = search_.found();
  parallel_for(static_cast<std::ptrdiff_t>(contacts.nodes.size()), [&](std::ptrdiff_t k) {
    const ContactNode<Dim>& node = contacts.nodes[static_cast<std::size_t>(k)];
    for (std::size_t p = node.first_pair; p < node.end_pair; ++p) {
      ContactPair& pair = contacts.pairs[p];
      if (pair.crack >= 0 || pair.law->interface()) continue;
      const auto home = [&](std::size_t member) { return system_.fields[contacts.members[member].field].base_field; };
      const ContactFace& face = cache_.face(p);
      const bool has_face = !pair.has_no_face && pair.law->uses_face();
      const double not_beyond = has_face ? face.offset_along_face + h_ : std::numeric_limits<double>::max();
      const auto joint =
          joints.near_joint(home(pair.a), home(pair.b), system_.lattice.position(node.index), not_beyond);
      const bool beyond = has_face && joint.distance > not_beyond &&
                          std::abs(face.normal.template head<Dim>().dot(joint.normal)) > min_cosine;
      pair.replaced_by_joint = std::isfinite(joint.distance) && !beyond;
    }
  });
}

template <int Dim>
void Contact<Dim>::apply(double dt, Pass pass) {
  if (!active_) return;
  const auto lap = watch.lap();
  node_impulses_.apply(dt, pass);
  face_solver_.apply(dt, pass);
}

template <int Dim>
void Contact<Dim>::remove_start_impulses() {
  if (!active_) return;
  const auto lap = watch.lap();
  face_solver_.remove();
  node_impulses_.remove();
}

template <int Dim>
void Contact<Dim>::constrain_increments(Pass pass) {
  if (!active_) return;
  node_impulses_.constrain_increments(pass);
  face_solver_.constrain_increments(pass);
}

template <int Dim>
void Contact<Dim>::keep_start(bool strain_filtered) {
  if (!active_) return;
  const auto lap = watch.lap();
  face_solver_.find_velocities(strain_filtered);
  ledger_.keep_start(search_.found(), strain_filtered);
}

template <int Dim>
void Contact<Dim>::record(double dt, double flip, bool filtered) {
  if (!active_) return;
  const auto lap = watch.lap();
  auto& contacts = search_.found();
  if (cracks_.active()) {
    cracks_.begin_record();
    for (const auto& node : contacts.nodes)
      for (const ContactPair& pair : contacts.pairs_of(node))
        if (pair.crack >= 0 && !pair.has_no_face) cracks_.record(pair, node.index);
    cracks_.end_record();
  }
  const bool keeps = keeps_start_impulses_;
  ledger_.record(contacts, dt, !keeps && flip == 0.0, filtered, keeps ? 1.0 - flip : 0.0);
  if (laws_.any_has_memory()) memory_.update();
}

template <int Dim>
void Contact<Dim>::record_end(bool filtered, bool strain_filtered) {
  if (!active_) return;
  const auto lap = watch.lap();
  face_solver_.find_velocities(strain_filtered);
  ledger_.record_end(search_.found(), filtered, strain_filtered);
}

template <int Dim>
void Contact<Dim>::archive_kept(Archive& a) {
  a.version(2);
  a("faces", cache_);
  if (a.reading() && !cache_.fits(bodies_)) refuse_checkpoint("a face of contact has a particle that does not exist");
}

template <int Dim>
void Contact<Dim>::collect_faces() {
  if (!active_) return;
  search_.collect();
  collected_ = ranks().gather(cache_.portable_faces(bodies_, true));
}

template <int Dim>
void Contact<Dim>::place_collected_faces() {
  if (active_) cache_.take_faces(collected_, bodies_);
  collected_.clear();
}

template <int Dim>
void Contact<Dim>::pack_faces() {
  if (active_) collected_ = {cache_.portable_faces(bodies_, false)};
}

template <int Dim>
void Contact<Dim>::unpack_faces() {
  place_collected_faces();
  cache_.forget_former();
}

template <int Dim>
void Contact<Dim>::fill_view() {
  if (!active_ || has_all_particles_) return;
  for (auto& node : search_.found().nodes) node.needs_faces = node.between_bodies;
  collect_particles();
  fill_contact_view<Dim>(system_, search_, cloud_, bodies_);
  cloud_.release();
}

template class Contact<2>;
template class Contact<3>;

}  // namespace tribo
