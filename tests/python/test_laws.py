# SPDX-License-Identifier: MIT
"""Material and contact laws that are written in Python."""

import unittest

import numpy as np
import tribo
from common import InFolder, sliding_block


@tribo.register
class OwnElastic(tribo.MaterialLaw):
    """Isotropic elasticity as a law of Tribo has it."""

    parameters = {"E": tribo.Parameter("stress", low=0, open=True, meaning="Young's modulus"),
                  "nu": tribo.Parameter(default=0.3, low=-1, high=0.5, open=True)}
    state = {"work": ("-", 0.0)}

    def prepare(self):
        self.G = self.E / (2 * (1 + self.nu))
        self.lame = self.E * self.nu / ((1 + self.nu) * (1 - 2 * self.nu))
        if self.nu == 0.123:
            raise ValueError("0.123 is no good")

    def wave_modulus(self):
        return self.lame + 2 * self.G

    def stress(self, p):
        trace = np.trace(p.D, axis1=1, axis2=2)[:, None, None]
        new = p.rotated() + p.dt * (self.lame * trace * np.eye(3) + 2 * self.G * p.D)
        p.state["work"] += p.dt * np.einsum("nij,nij->n", new, p.D)
        return new

    def energy(self, p):
        trace = np.trace(p.stress, axis1=1, axis2=2)
        square = np.einsum("nij,nij->n", p.stress, p.stress)
        return (square - self.nu / (1 + self.nu) * trace**2) / (4 * self.G)


@tribo.register
class OwnFriction(tribo.ContactLaw):
    """Coulomb friction."""

    parameters = {"coeff": tribo.Parameter(low=0, meaning="friction coefficient")}
    needs_closed_faces = True

    def response(self, s):
        contact = s.normal_contact()
        return s.frictional(self.coeff * contact.pressure) if contact.closed else None


class Materials(InFolder):
    def model(self, law, **properties):
        m = tribo.Model("plane strain")
        m.mpm_method("USL", "B2SPLINE")
        m.grid(x=(0, 1), y=(0, 1), cell=0.1)
        m.material("block", law, rho=2000, E=1e6, **properties)
        m.body("block", tribo.rect(0.3, 0.7, 0.3, 0.7))
        with m.region("block", 1, 2):
            m.shapes(tribo.rect(0.7, 0.9, 0.3, 0.7))
        m.time(0.01, step=2e-4, courant=0.4)
        m.output(0.01)
        m.history("Kinetic Energy")
        m.history("Strain Energy")
        return m

    def test_the_same_as_in_cpp(self):
        one, two = (self.model(law, nu=0.3).run(folder=law) for law in ("LinearElastic", "OwnElastic"))
        for name in ("Kinetic Energy", "Strain Energy"):
            np.testing.assert_allclose(two.history[name], one.history[name], rtol=2e-3, atol=1e-6)
        self.assertGreater(two.history["Strain Energy"][-1], 0)
        self.assertEqual(two.frames[-1]["work"].shape, two.frames[-1]["id"].shape)
        with tribo.simulate(self.model("OwnElastic"), threads=2) as simulation:
            frame = simulation.advance(4)
            self.assertGreater(np.abs(frame.particles["work"]).max(), 0)
            frame.bodies["block"].writable("work")[:] = 7
            self.assertGreater(simulation.advance(1).bodies["block"]["work"].min(), 6)

    def test_threads_do_not_change_the_results(self):
        self.model("OwnElastic").run(folder="one", threads=1)
        self.model("OwnElastic").run(folder="two", threads=2)
        self.assert_same_results("one", "two")

    def test_drive(self):
        options = {"test": "oedometer", "strain": 0.001, "steps": 5}
        one = tribo.drive(law="LinearElastic", properties={"rho": 1, "E": 1e6, "nu": 0.3}, **options)
        two = tribo.drive(law="OwnElastic", properties={"rho": 1, "E": 1e6}, **options)
        np.testing.assert_allclose(two["syy"], one["syy"], rtol=1e-6)

    def test_messages(self):
        with self.assertRaisesRegex(tribo.InputError, "'nu' is 0.7 but must be in"):
            self.model("OwnElastic", nu=0.7).check()
        with self.assertRaisesRegex(tribo.InputError, "0.123 is no good"):
            self.model("OwnElastic", nu=0.123).check()
        with self.assertRaisesRegex(tribo.InputError, "did you mean 'OwnElastic'"):
            self.model("OwnElastik").check()
        with self.assertRaisesRegex(ValueError, "already a law 'MohrCoulomb'"):
            tribo.register(OwnElastic, "MohrCoulomb")
        with self.assertRaisesRegex(TypeError, "a class of tribo.MaterialLaw or tribo.ContactLaw"):
            tribo.register(int)

    def assert_refused(self, error, text, stress=None, **members):
        """That a law with this stress ends a run and a drive with an error."""
        law = type("Broken", (OwnElastic,), {**({"stress": stress} if stress else {}), **members})
        tribo.register(law, "Broken")  # replaces the former one
        with self.assertRaisesRegex(error, text):
            self.model("Broken").run(folder="broken", overwrite=True, threads=2)
        with self.assertRaisesRegex(error, text):
            tribo.drive(law="Broken", properties={"rho": 1, "E": 1e6}, test="triaxial_compression", strain=0.01, pressure=1e3)

    def test_what_a_law_returns(self):
        shape = r"stress\(\) of 'Broken' must give an array of the shape \(\d+, 3, 3\), not"
        self.assert_refused(ValueError, r"stress\(\) of 'Broken' returned None", lambda self, p: None)
        self.assert_refused(ValueError, shape, lambda self, p: np.zeros(3))
        self.assert_refused(ValueError, shape, lambda self, p: np.zeros((3, 3)))
        self.assert_refused(ValueError, shape, lambda self, p: np.zeros((len(p), 6)))
        self.assert_refused(ValueError, shape, lambda self, p: "nothing")
        self.assert_refused(tribo.NumericalError, r"stress\(\) of 'Broken' returned values that are not finite",
                            lambda self, p: np.nan * p.stress)
        self.assert_refused(AttributeError, "needs_deformation = True", lambda self, p: p.F)

        def forgetful(self, p):
            p.state["work"] = p.state["work"] * np.nan
            return OwnElastic.stress(self, p)

        self.assert_refused(tribo.NumericalError, "'Broken', in the state 'work', returned values that are not finite", forgetful)

    def test_what_an_energy_returns(self):
        tribo.register(type("Broken", (OwnElastic,), {"energy": lambda self, p: None}), "Broken")
        with self.assertRaisesRegex(ValueError, r"energy\(\) of 'Broken' returned None"):
            self.model("Broken").run()

    def test_a_trial_without_a_stress_does_not_end_a_drive(self):
        class Bounded(OwnElastic):
            """It has no stress for rates that are too large, which the driver tries."""

            def stress(self, p):
                return OwnElastic.stress(self, p) * (1 if np.abs(p.D).max() * p.dt < 0.3 else np.nan)

        tribo.register(Bounded)
        options = {"properties": {"rho": 1, "E": 1e6}, "path": {"dt": 1, "steps": [4], "sxx": 4e5, "Lyy": 0, "Lzz": 0}}
        one, two = (tribo.drive(law=law, **options) for law in ("OwnElastic", "Bounded"))
        np.testing.assert_allclose(two["sxx"], one["sxx"], rtol=1e-6)

    def test_the_deformation_gradient_is_there_for_those_who_ask(self):
        seen = []

        class Deformed(OwnElastic):
            needs_deformation = True

            def stress(self, p):
                seen.append(p.F.shape)
                return OwnElastic.stress(self, p)

        tribo.register(Deformed)
        self.model("Deformed").run()
        self.assertEqual(seen[0][1:], (3, 3))

    def test_values_of_parameters(self):
        self.assertEqual(OwnElastic(E=1e6).nu, 0.3)
        with self.assertRaisesRegex(TypeError, r"OwnElastic\(\) needs the parameter 'E'"):
            OwnElastic()
        with self.assertRaisesRegex(ValueError, r"'nu' of OwnElastic is 0.7 but must be in \(-1, 0.5\)"):
            OwnElastic(E=1e6, nu=0.7)
        with self.assertRaisesRegex(ValueError, "'E' of OwnElastic is -1 but must be > 0"):
            OwnElastic(E=-1)
        with self.assertRaisesRegex(TypeError, "has no parameter 'Young'; it has: rho, E, nu"):
            OwnElastic(Young=1)
        with self.assertRaisesRegex(TypeError, "'E' among the parameters of Wrong must be a tribo.Parameter"):
            tribo.register(type("Wrong", (tribo.MaterialLaw,), {"parameters": {"E": 1.0}}))

    def test_manual(self):
        text = tribo.doc("ownelastic")
        self.assertIn("OwnElastic, a material of Python", text)
        self.assertIn("Isotropic elasticity as a law of Tribo has it.", text)
        self.assertIn("nu  [-, in (-1, 0.5)]: nu; default 0.3", text)
        self.assertEqual(tribo.keywords("material").count("OwnElastic"), 1)
        self.assertIn("OwnFriction", tribo.keywords("contact law"))
        self.assertEqual(tribo.parameters("OwnFriction")["coeff"], ("-, >= 0", "friction coefficient; required"))

    def test_a_law_that_was_not_registered(self):
        with self.assertRaises(tribo.InputError) as caught:
            tribo.drive(law="Nope", properties={"rho": 1}, test="oedometer", strain=0.1)
        self.assertEqual([p.message.split(";")[0] for p in caught.exception.problems], ["there is no material type 'Nope'"])
        self.assertIn("known after tribo.register", str(caught.exception))

    def test_energy_that_a_law_does_not_tell(self):
        class Silent(OwnElastic):
            energy = property()  # hides that of the base

        tribo.register(Silent)
        m = self.model("Silent")
        m.prescribe(tribo.rect(0, 0.35, 0, 1), x=0, y=0)  # the body runs up against a wall
        m.time(0.1, step=2e-4, courant=0.4)
        with self.assertWarnsRegex(tribo.RunWarning, "lacks .* has no method energy.p. and no state 'dissipation'") as caught:
            results = m.run()
        self.assertEqual(caught.filename, __file__)
        self.assertTrue(any("lacks" in line for line in results.remarks))
        self.assertTrue(any("lacks" in line for line in results.provenance["to_look_at"]))
        self.assertFalse(any("lacks" in line for line in results.provenance.get("figures", [])))

    def test_errors_in_the_law(self):

        @tribo.register
        class Broken(OwnElastic):
            def stress(self, p):
                return self.nothing

        with self.assertRaisesRegex(AttributeError, "nothing"):
            self.model("Broken").run(folder="broken2", threads=2)


class Contacts(InFolder):
    def test_the_same_as_in_cpp(self):
        m = sliding_block()
        own = tribo.Model("2D plane strain", title="A sliding block")
        own._lines = [line.replace('"CoulombFriction"', '"OwnFriction"') for line in m._lines]
        one, two = m.run(folder="one"), own.run(folder="two", threads=2)
        np.testing.assert_array_equal(two.history["velx:block"], one.history["velx:block"])
        self.assertLess(one.history["velx:block"][-1], 2)

    def test_check(self):
        self.assertEqual(tribo.check_contact_law(OwnFriction(coeff=0.4)), [])
        with self.assertRaisesRegex(TypeError, r"OwnFriction\(coeff=...\), not the class"):
            tribo.check_contact_law(OwnFriction)
        with self.assertRaisesRegex(ValueError, "'coeff' of OwnFriction is -1 but must be >= 0"):
            OwnFriction(coeff=-1)
        with self.assertRaisesRegex(TypeError, "needs the parameter 'coeff'"):
            OwnFriction()

        class Engine(tribo.ContactLaw):
            def response(self, s):
                return -2 * s.mass * s.velocity

        self.assertIn("creates the energy", tribo.check_contact_law(Engine())[0])

        class OneSided(tribo.ContactLaw):
            def response(self, s):
                return s.mass * s.velocity if s.velocity[0] > 0 else None

        self.assertTrue(any("change its sign" in text for text in tribo.check_contact_law(OneSided())))

    def test_what_a_law_returns(self):
        for given, error, text in ((1.0, ValueError, r"response\(\) of 'Wrong' must give three numbers"),
                                   ([1, 2], ValueError, "not an array of the shape"),
                                   ([np.nan] * 3, tribo.NumericalError, "gave an impulse that is not finite")):
            law = type("Wrong", (tribo.ContactLaw,), {"response": lambda self, s, given=given: given})
            tribo.register(law, "Wrong")
            m = tribo.Model("2D plane strain")
            m._lines = [line.replace('"CoulombFriction"', '"Wrong"') for line in sliding_block()._lines if "coeff" not in line]
            with self.assertRaisesRegex(error, text):
                m.run(overwrite=True)

    def test_impulses_as_arrays(self):
        @tribo.register
        class Sticks(tribo.ContactLaw):
            """Faces that touch stick."""

            def response(self, s):
                return s.mass * s.velocity if s.gap <= 0 else None

        m = tribo.Model("2D plane strain")
        m._lines = [line.replace('"CoulombFriction"', '"Sticks"') for line in sliding_block()._lines if "coeff" not in line]
        speed = m.run().history["velx:block"]
        self.assertLess(speed[-1], 0.5 * speed[0])  # the block shears and stops


if __name__ == "__main__":
    unittest.main()
