"""OpenTURNS on a motion, and the examples."""

import os
import subprocess
import sys
import unittest

import boresight as bs
import numpy

EXAMPLES = os.environ["BORESIGHT_EXAMPLES"]
FOUR_BAR = os.path.join(EXAMPLES, "four-bar", "four-bar.toml")


def example(name, *words):
    return subprocess.run([sys.executable, os.path.join(EXAMPLES, "python", name), *words], capture_output=True, text=True,
                          check=False)


class Python(unittest.TestCase):
    def test_openturns_is_not_loaded_before_it_is_asked_for(self):
        code = "import sys, boresight; sys.exit('openturns' in sys.modules)"
        self.assertEqual(subprocess.run([sys.executable, "-c", code], check=False).returncode, 0)

    def test_an_openturns_function_has_the_values_and_the_gradient(self):
        m = bs.Mechanism(FOUR_BAR, {"motion.duration": "20 ms"})
        f = bs.Function(m, ["clearance.D.radial"], index="position_error.rms", rung="perturbation", integrator="rosenbrock",
                        tolerance=1e-6)
        function = bs.openturns(f)
        x = f.nominal
        self.assertEqual(list(function(x)), [f(x)])
        self.assertEqual([row[0] for row in function([x, 1.1 * x])], list(f.batch([x, 1.1 * x]).values))
        self.assertEqual(function.gradient(x)[0, 0], f.gradient(x)[0])
        self.assertEqual(function.getInputDescription()[0], "clearance.D.radial")
        rough = bs.openturns(f, gradient="differences", steps=[1e-3 * x[0]])
        self.assertAlmostEqual(rough.gradient(x)[0, 0] / f.gradient(x)[0], 1.0, delta=0.02)
        smooth = bs.Function(m, ["clearance.D.radial"], rung="quasistatic")
        self.assertGreater(bs.openturns(smooth).gradient(x)[0, 0], 0.0)
        with self.assertRaises(bs.ComputationError):
            bs.openturns(smooth, gradient="exact")
        with self.assertRaises(bs.InputError):
            bs.openturns(bs.Function(m, ["gravity.x"], rung="quasistatic"))

    def test_a_function_is_what_an_optimiser_calls(self):
        f = bs.Function(bs.Mechanism(FOUR_BAR, {"motion.duration": "20 ms"}), ["clearance.D.radial"], rung="quasistatic")
        value = f(numpy.array([1e-4]))
        self.assertIsInstance(value, float)
        self.assertEqual(value, f([1e-4]))
        self.assertEqual(value, f(1e-4))

    def test_the_example_of_reliability_finds_what_it_says(self):
        ran = example("reliability.py", "--quick")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertIn("Sobol' indices of clearance.D.radial", ran.stdout)
        self.assertIn("beta = 2.0", ran.stdout)
        print(ran.stdout)

    def test_the_example_of_scatter_finds_what_it_says(self):
        ran = example("scatter.py")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        self.assertIn("correlation with the clearance 0.9", ran.stdout)


if __name__ == "__main__":
    unittest.main()
