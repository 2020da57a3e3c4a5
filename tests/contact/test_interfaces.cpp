// SPDX-License-Identifier: MIT
#include "contact/contact_cases.hpp"
#include "contact/interface.hpp"

#include <catch2/catch.hpp>

using namespace tribo;
using namespace tribo::test;

namespace {

// Oscillator under a constant force.
double exact_opening(double mass, double k, double f, double d0, double v0, double t) {
  const double w = std::sqrt(k / mass);
  return d0 * std::cos(w * t) + v0 * std::sin(w * t) / w + f / k * (1 - std::cos(w * t));
}

}  // namespace

TEST_CASE("the steps of an interface run through the openings of the exact oscillation", "[contact]") {
  const double exact[] = {6.214436e-4, 5.896718e-4, 2.946413e-4, -9.666019e-4};
  const double stiffness[] = {1e2, 1e3, 1e4, 1e6};
  for (int n = 0; n < 4; ++n) {
    const double k = stiffness[n];
    CHECK(exact_opening(1.2, k, 3, 1e-3, -0.05, 0.01) == Approx(exact[n]).epsilon(1e-6));
    const double dt = n < 3 ? 1e-3 : 1e-4;  // phi = 0.009 ... 0.09
    double d = 1e-3, v = (exact_opening(1.2, k, 3, 1e-3, -0.05, dt) - d) / dt;
    d += dt * v;
    for (int s = 2; s <= std::lround(0.01 / dt); ++s) {
      const double free = v + 3 * dt / 1.2;
      v = free - spring_impulse(1.2, k, d, v, free, dt) / 1.2;
      d += dt * v;
    }
    CHECK(d == Approx(exact_opening(1.2, k, 3, 1e-3, -0.05, 0.01)).epsilon(1e-10));
  }
}

TEST_CASE("an interface is stable for any stiffness and step", "[contact]") {
  for (const double phi : {0.3, 0.99, 1.5, 1.99, 2.2, 2.9, 3.1, 5.0, 100.0, 1e6}) {
    double d = 1e-3, v = -0.05;
    const double k = phi * phi * 1.2 / 1e-4;
    double most = 0;
    for (int s = 0; s < 10000; ++s) {
      v -= spring_impulse(1.2, k, d, v, v, 0.01) / 1.2;
      d += 0.01 * v;
      most = std::max(most, std::abs(d));
    }
    CHECK(most < 2.5e-3);
    if (phi > 1) CHECK(std::abs(d) < 1e-12);
  }
}

TEST_CASE("the impulse of an interface is continuous in its stiffness and joins in the limit", "[contact]") {
  const auto J = [](double phi) { return spring_impulse(1.2, 1.2 * phi * phi / 1e-4, 1e-3, -0.05, 0.02, 0.01); };
  CHECK(J(3 * (1 - 1e-9)) == Approx(J(3 * (1 + 1e-9))).epsilon(1e-7));
  // A rigid spring closes the gap within the step (backward Euler).
  CHECK(J(1e7) == Approx(1.2 * (0.02 + 1e-3 / 0.01)).epsilon(1e-5));
}

TEST_CASE("a bilinear interface swings with half periods of its two stiffnesses and keeps its energy", "[contact]") {
  const auto law = make_law("62", {{"Dnt", "100"}, {"Dnc", "400"}, {"Dt", "0"}});
  ContactState m;
  m.mass = 1, m.dt = 1e-3, m.area = 1;
  double d = 0, v = 1, opened = 0, closed = 0, most = 0, least = 0;
  int sign = 1;
  std::vector<double> half;
  double last = 0;
  for (int step = 1; step <= 47124; ++step) {  // 100 periods of 0.4712389
    m.opening = Vec3(d, 0, 0), m.start = m.velocity = Vec3(v, 0, 0);
    const double before = d;
    v -= law->response(m).impulse[0], d += m.dt * v;
    if ((d > 0) != (sign > 0)) {
      const double t = (step - 1 + before / (before - d)) * m.dt;
      half.push_back(t - last), last = t, sign = -sign;
    }
    most = std::max(most, d), least = std::min(least, d);
  }
  for (std::size_t k = 0; k < half.size(); ++k) (k % 2 == 0 ? opened : closed) += half[k];
  CHECK(opened / static_cast<double>((half.size() + 1) / 2) == Approx(0.314159265).epsilon(1e-3));
  CHECK(closed / static_cast<double>(half.size() / 2) == Approx(0.157079633).epsilon(1e-3));
  CHECK(-least / most == Approx(0.5).epsilon(1e-3));
  const double middle = d - 0.5 * m.dt * v;  // where the velocity belongs
  CHECK(0.5 * v * v + (middle > 0 ? 50 : 200) * middle * middle == Approx(0.5).epsilon(1e-3));
}

TEST_CASE("perfect directions stick; a perfect side is a stop", "[contact]") {
  ContactState m = plain_meeting();
  m.opening = 1e-3 * m.normal, m.start = m.velocity;
  CHECK((make_law("62", {})->response(m).impulse - m.mass * m.velocity).norm() < 1e-15);
  const auto stop = make_law("62", {{"Dnt", "100"}, {"Dnc", "-1"}, {"Dt", "0"}});
  // closes with 0.88: open by 1e-3 it may close 1e-3 in this step, touching it may not close at all
  const auto end = [&](double opening) {
    m.opening = opening * m.normal;
    return (m.velocity - stop->response(m).impulse / m.mass).dot(m.normal);
  };
  CHECK(end(0.5e-3) == Approx(-0.5).epsilon(1e-12));
  CHECK(end(0.0) == Approx(0.0).margin(1e-13));
  CHECK(end(-1e-5) == Approx(0.0).margin(1e-13));
  m.velocity = m.start = Vec3(0.8, 0.6, 0);
  CHECK(end(0.0) == Approx(1.0).epsilon(1e-4));  // free to open
}

TEST_CASE("interfaces mirror, and only give back what they stored", "[contact]") {
  std::mt19937 random(2);
  std::vector<std::unique_ptr<ContactLaw>> laws;
  laws.push_back(make_law("62", {{"Dn", "20"}, {"Dt", "5"}}));
  laws.push_back(make_law("62", {{"Dnt", "20"}, {"Dnc", "2000"}, {"Dt", "-1"}}));
  laws.push_back(make_law("65", {{"Dnt", "20"}, {"Dt", "5"}}));
  laws.push_back(make_law(
      "65",
      {{"Dnt", "20"}, {"Dt", "5"}, {"normal_shape", "1"}, {"Npeak", "1"}, {"tangential_shape", "1"}, {"Tpeak", "1"}}));
  for (auto& law : laws)
    for (int n = 0; n < 2000; ++n) {
      const ContactState m = random_meeting(random);
      const ContactResponse a = law->response(m), b = law->response(mirrored(m));
      REQUIRE((a.impulse + b.impulse).norm() <= 1e-13 * (1 + a.impulse.norm()));
      REQUIRE(a.stored == Approx(b.stored).epsilon(1e-12));
      REQUIRE(a.stored >= 0);
    }
}

TEST_CASE("a linear shape of the nonlinear interface agrees with the linear law to second order", "[contact]") {
  const auto linear = make_law("62", {{"Dn", "20"}, {"Dt", "5"}}),
             general = make_law("65", {{"Dn", "20"}, {"Dt", "5"}});
  ContactState m = plain_meeting();
  m.opening = Vec3(1e-3, 2e-3, 0), m.start = Vec3(-1.9, 1.3, 0);
  double before = 0;
  for (const double dt : {0.04, 0.02, 0.01}) {
    m.dt = dt, m.velocity = m.start + dt * Vec3(3, -2, 0);
    const double error = (linear->response(m).impulse - general->response(m).impulse).norm() / dt;
    if (before > 0) CHECK(before / error > 3.5);
    before = error;
  }
}

TEST_CASE("Morse's law has its slope, its peak, and softens", "[contact]") {
  const auto law = make_law("65", {{"Dnt", "400"}, {"Dt", "0"}, {"normal_shape", "1"}, {"Npeak", "10"}});
  ContactState m;
  m.mass = 1e9, m.dt = 1e-6, m.area = 1;  // too heavy to move
  const auto traction = [&](double d) {
    m.opening = Vec3(d, 0, 0);
    return law->response(m).impulse[0] / m.dt;
  };
  CHECK(traction(1e-7) == Approx(400e-7).epsilon(1e-5));
  CHECK(traction(std::log(2.0) / 10) == Approx(10).epsilon(1e-6));
  CHECK(traction(0.2) < traction(0.1));
  CHECK(traction(-1e-3) == Approx(-0.4).epsilon(1e-6));
  m.opening = Vec3(100, 0, 0);
  CHECK(law->response(m).stored == Approx(8 * 100.0 / 400).epsilon(1e-9));  // the well's depth: what it costs to part
}

TEST_CASE("the bilinear shape rises, falls straight, and ends", "[contact]") {
  const auto law = make_law("65", {{"Dnt", "400"},
                                   {"Dt", "100"},
                                   {"normal_shape", "2"},
                                   {"Npeak", "10"},
                                   {"Nbreak", "0.1"},
                                   {"tangential_shape", "2"},
                                   {"Tpeak", "4"},
                                   {"Tbreak", "0.2"}});
  ContactState m;
  m.mass = 1e9, m.dt = 1e-6, m.area = 1;  // too heavy to move
  const auto traction = [&](double normal, double slip) {
    m.opening = Vec3(normal, slip, 0);
    return Vec3(law->response(m).impulse / m.dt);
  };
  CHECK(traction(0.02, 0)[0] == Approx(8).epsilon(1e-9));    // 400 * 0.02
  CHECK(traction(0.025, 0)[0] == Approx(10).epsilon(1e-9));  // the peak
  CHECK(traction(0.0625, 0)[0] == Approx(5).epsilon(1e-9));  // half way down
  CHECK(traction(0.11, 0)[0] == 0.0);
  CHECK(traction(-0.01, 0)[0] == Approx(-4).epsilon(1e-9));  // closed it stays linear
  CHECK(traction(0, 0.03)[1] == Approx(3).epsilon(1e-9));
  CHECK(traction(0, -0.12)[1] == Approx(-2).epsilon(1e-9));  // against the slip, half way down
  m.opening = Vec3(0.5, 0, 0);
  CHECK(law->response(m).stored == Approx(0.5 * 10 * 0.1).epsilon(1e-9));  // the triangle
}
