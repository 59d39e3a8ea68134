"""Mechanisms, motions and functions from Python."""

import gc
import os
import subprocess
import tempfile
import threading
import time
import unittest

import boresight as bs
import numpy

EXAMPLES = os.environ["BORESIGHT_EXAMPLES"]
PROGRAM = os.environ["BORESIGHT_PROGRAM"]
MECHANISM = os.path.join(EXAMPLES, "3-rrcpr", "3-rrcpr.toml")
FOUR_BAR = os.path.join(EXAMPLES, "four-bar", "four-bar.toml")
SHORT = {"motion.duration": "20 ms"}
INPUTS = ["clearance.F1.radial", "clearance.F1.contact.restitution", "clearance.F1.friction.coefficient"]


def points(count):
    draw = numpy.random.default_rng(1)
    return numpy.column_stack([draw.uniform(0.5e-4, 1.5e-4, count), draw.uniform(0.7, 0.95, count),
                               draw.uniform(0.01, 0.05, count)])


class Python(unittest.TestCase):
    def test_run_gives_what_the_command_gives(self):
        with tempfile.TemporaryDirectory() as folder:
            for rung in ("quasistatic", "perturbation", "multibody"):
                out = os.path.join(folder, rung)
                subprocess.run([PROGRAM, "run", MECHANISM, "--rung", rung, "--set", "motion.duration=20ms", "--out", out,
                                "--step-error", "off", "--quiet"], check=True)
                summary = bs.Result("run", 0, out).summary
                run = bs.run(bs.Mechanism(MECHANISM, SHORT), rung=rung)
                self.assertEqual(run.index, summary["index"])
                self.assertEqual(run.contact["F1"]["impacts"], summary["contact"]["F1"]["impacts"])

    def test_histories_are_views_that_outlive_the_run(self):
        run = bs.run(bs.Mechanism(MECHANISM, SHORT), rung="perturbation", poses=["rod1"])
        n = len(run.time)
        self.assertEqual(run.boresight.displacement.shape, (n, 3))
        self.assertEqual(run.boresight.orientation.shape, (n, 4))
        self.assertEqual(run.poses["rod1"].position.shape, (n, 3))
        self.assertEqual(run.clearances["F1"].offset.shape, (n, 3))
        self.assertFalse(run.boresight.displacement.flags.owndata)
        # The same memory each time it is asked for.
        self.assertEqual(run.time.ctypes.data, run.time.ctypes.data)
        self.assertTrue(numpy.shares_memory(run.boresight.position, run.boresight.position))
        with self.assertRaises(ValueError):
            run.time[0] = 1.0
        size = numpy.linalg.norm(run.boresight.displacement, axis=1)
        numpy.testing.assert_allclose(size, run.boresight.position_error, rtol=1e-12, atol=1e-18)
        numpy.testing.assert_allclose(run.boresight.position - run.boresight.ideal_position, run.boresight.displacement,
                                      atol=1e-15)
        kept, copy = run.boresight.displacement, run.boresight.displacement.copy()
        del run
        gc.collect()
        numpy.testing.assert_array_equal(kept, copy)

    def test_parameters_go_by_their_paths(self):
        m = bs.Mechanism(MECHANISM, SHORT)
        p = m.parameters()
        p["clearance.F1.radial"] = "0.2 mm"
        self.assertEqual(p["clearance.F1.radial"], 0.2e-3)
        self.assertEqual(m.parameters()["clearance.F1.radial"], 0.1e-3)
        self.assertEqual(m.unit("clearance.F1.radial"), "m")
        self.assertIn("payload.mass", m.paths)
        wide = bs.run(m, p, rung="quasistatic").index
        self.assertEqual(wide, bs.run(bs.Mechanism(MECHANISM, {**SHORT, "clearance.F1.radial": "0.2 mm"}),
                                      rung="quasistatic").index)
        for value in (-1e-4, "0.2 kg", "0.2", float("nan"), 1e9):
            with self.assertRaises(bs.InputError) as caught:
                p["clearance.F1.radial"] = value
            self.assertEqual(caught.exception.key, "clearance.F1.radial")

    def test_a_path_of_numbers_that_differ_gives_and_takes_each(self):
        m = bs.Mechanism(FOUR_BAR, SHORT)
        path = "clearance.D.contact.young"
        p, file = m.parameters(), m.parameters().as_dict()
        self.assertEqual(p[path], (207e9, 72e9))
        p[path] = p[path]
        self.assertEqual(p.as_dict(), file)
        for every, value in p.as_dict().items():
            p[every] = value
        self.assertEqual(p.as_dict(), file)
        p[path] = ["72 GPa", 207e9]
        self.assertEqual(p[path], (72e9, 207e9))
        p[path] = numpy.array([1e11, 2e11])
        self.assertEqual(p[path], (1e11, 2e11))
        p[path] = numpy.float64(72e9)
        self.assertEqual(p[path], 72e9)
        for wrong in ((1e11, 2e11, 3e11), (), (1e11, -1.0)):
            with self.assertRaises(bs.InputError):
                p[path] = wrong
        self.assertEqual(p[path], 72e9)
        with self.assertRaisesRegex(bs.InputError, "values from 7.2e\\+10 to 2.07e\\+11 Pa"):
            bs.Function(m, [path], rung="quasistatic").nominal

    def test_what_is_no_number_is_refused_in_words(self):
        m = bs.Mechanism(MECHANISM, SHORT)
        p = m.parameters()
        for wrong, found in ((None, "None"), ({}, "{}"), (1j, "1j"), ([None], "None")):
            with self.assertRaisesRegex(bs.InputError, "clearance.F1.radial: found " + found + ", expected a number of m"):
                p["clearance.F1.radial"] = wrong
        for settings in ({"clearance.F1.radial": None}, {1: "2 mm"}):
            with self.assertRaises(bs.InputError):
                bs.Mechanism(MECHANISM, settings)

    def test_numbers_that_do_not_fit_together_are_refused_where_they_are_computed_with(self):
        m = bs.Mechanism(MECHANISM, SHORT)
        p = m.parameters()
        p["clearance.F1.radial"] = "30 mm"  # of a journal of 10 mm, which may yet be set
        f = bs.Function(m, ["clearance.F1.radial", "clearance.F1.cap_radius"], rung="perturbation")
        for key, wrong in (("radial", lambda: bs.run(m, p, rung="quasistatic")),
                           ("cap_radius", lambda: f([9e-3, 16e-3])),
                           ("cap_radius", lambda: f.batch([[1e-4, 16e-3], [9e-3, 16e-3]]))):
            with self.assertRaises(bs.InputError) as caught:
                wrong()
            self.assertEqual(caught.exception.key, "clearance.F1." + key)

    def test_every_number_has_the_range_of_its_key(self):
        for name in ("3-rrcpr/3-rrcpr.toml", "bearing-pairs/gimbal.toml", "hexapod/hexapod.toml",
                     "altaz-gimbal/altaz-gimbal.toml", "crank-slider/crank-slider.toml", "pendulum/pendulum.toml"):
            p = bs.Mechanism(os.path.join(EXAMPLES, name)).parameters()
            for path, value in p.as_dict().items():
                if value != 0.0:
                    p[path] = value
                for wrong in (1e30, float("inf")):
                    with self.assertRaises(bs.InputError, msg=path):
                        p[path] = wrong

    def test_errors_have_file_line_and_key(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            with open(FOUR_BAR, encoding="utf-8") as good:
                text = good.read()
            at = text.index("mass = ")
            file.write(text[:at] + "mas = " + text[at + 7:])
            file.flush()
            with self.assertRaises(bs.InputError) as caught:
                bs.Mechanism(file.name)
        error = caught.exception
        self.assertEqual((error.file, error.line), (file.name, text[:at].count("\n") + 1))
        self.assertTrue(error.key.endswith("mas"), error.key)
        self.assertEqual(error.nearest, "mass")
        self.assertTrue(str(error).startswith(f"{file.name}:{error.line}: "))
        for wrong in (lambda: bs.Mechanism("nowhere.toml"), lambda: bs.run(bs.Mechanism(FOUR_BAR), rung="multibodi"),
                      lambda: bs.run(bs.Mechanism(FOUR_BAR), integrator="rk5"),
                      lambda: bs.Function(bs.Mechanism(FOUR_BAR), ["clearance.D.radia"]),
                      lambda: bs.Function(bs.Mechanism(FOUR_BAR), ["gravity.z"], index="position_error.maximum")):
            self.assertRaises(bs.InputError, wrong)
        self.assertTrue(issubclass(bs.InputError, ValueError))

    def test_a_mechanism_from_a_dictionary_is_that_of_its_file(self):
        import tomllib

        with open(FOUR_BAR, "rb") as file:
            description = tomllib.load(file)
        built = bs.mechanism_from_dict(description, "built")
        read = bs.Mechanism(FOUR_BAR)
        self.assertEqual(built.parameters().as_dict(), read.parameters().as_dict())
        self.assertEqual(bs.run(built, rung="quasistatic").index, bs.run(read, rung="quasistatic").index)
        description["gravity"] = ["0 m", "0 m", "0 m"]
        with self.assertRaises(bs.InputError) as caught:
            bs.mechanism_from_dict(description, "built")
        self.assertEqual(caught.exception.file, "built")
        self.assertGreater(caught.exception.line, 0)

    def test_a_batch_is_its_points_one_by_one(self):
        f = bs.Function(bs.Mechanism(MECHANISM, SHORT), INPUTS, rung="perturbation")
        x = points(40)
        values = f.batch(x, jobs=2).values
        self.assertEqual(values.shape, (40,))
        self.assertFalse(values.flags.owndata)
        self.assertEqual([f(one) for one in x], list(values))
        self.assertEqual(list(f.batch(x[::-1], jobs=1).values), list(values[::-1]))
        self.assertEqual(f.units, ["m", "1", "1"])
        self.assertEqual(len(f.batch(numpy.empty((0, 3)))), 0)
        for wrong in ([1e-4], [[1e-4, 0.9, 0.03]], [1e-4, 0.9, -1.0]):
            with self.assertRaises(bs.InputError):
                f(wrong)
        with self.assertRaises(bs.InputError):
            f.batch(x[0])

    def test_a_batch_takes_less_than_one_per_cent_more_than_its_motions(self):
        f = bs.Function(bs.Mechanism(MECHANISM, {"motion.duration": "500 ms"}), INPUTS, rung="perturbation")
        x = points(1024)
        f.batch(x[:1])  # the scene, once for all
        shares = []
        for _ in range(3):
            start = time.process_time()
            motions = f.batch(x, jobs=1).cpu_seconds_in_all
            shares.append((time.process_time() - start) / motions - 1.0)
        print(f"CPU that a batch of 1024 points takes beside the library's own: {100 * min(shares):.3f} %")
        self.assertLess(min(shares), 0.01)

    def test_gradients_are_those_of_neighbouring_motions(self):
        m = bs.Mechanism(FOUR_BAR, SHORT)
        f = bs.Function(m, ["clearance.D.radial"], index="position_error.rms", rung="perturbation",
                        integrator="rosenbrock", tolerance=1e-6)
        x = f.nominal
        h = 1e-3 * x
        difference = (f(x + h) - f(x - h)) / (2 * h[0])
        self.assertAlmostEqual(f.gradient(x)[0] / difference, 1.0, delta=0.02)
        other = bs.Function(m, ["clearance.D.radial"], rung="quasistatic")
        self.assertIn("perturbation", other.why_no_gradient)
        with self.assertRaises(bs.ComputationError):
            other.gradient(x)

    def test_other_threads_go_on_while_a_motion_is_followed(self):
        m = bs.Mechanism(MECHANISM, {"motion.duration": "200 ms"})
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        ticker = threading.Thread(target=tick)
        ticker.start()
        start = time.monotonic()
        bs.run(m, rung="multibody", step=2e-6)
        end = time.monotonic()
        done.set()
        ticker.join()
        self.assertGreater(len([t for t in ticks if start < t < end]), 10)

    def test_progress_is_told_and_may_end_the_work(self):
        m = bs.Mechanism(MECHANISM, {"motion.duration": "1000 s"})
        told = []

        def progress(done, total, unit, estimate):
            told.append((done, total, unit))
            if len(told) == 3:
                raise LookupError("enough")

        with self.assertRaises(LookupError):
            bs.run(m, rung="multibody", step=1e-6, sample=0.0, events=False, progress=progress)
        self.assertEqual(told[-1][1:], (1000.0, "s of motion"))
        self.assertLess(told[0][0], told[-1][0])

    def test_ctrl_c_ends_a_motion_and_a_batch(self):
        code = (
            "import boresight as bs, os, signal, sys, threading\n"
            "m = bs.Mechanism(sys.argv[1], {'motion.duration': '1000 s'})\n"
            "f = bs.Function(m, ['payload.mass'], rung='multibody', step=1e-6)\n"
            "for work in (lambda: bs.run(m, step=1e-6, sample=0.0, events=False), lambda: f.batch([[1.0], [2.0]])):\n"
            "    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
            "    try:\n"
            "        work()\n"
            "    except KeyboardInterrupt:\n"
            "        print('interrupted')\n")
        done = subprocess.run(["/usr/bin/python3", "-c", code, MECHANISM], capture_output=True, text=True, timeout=100,
                              check=False)
        self.assertEqual(done.stdout, "interrupted\n" * 2, done.stderr)

    def test_what_the_stubs_say_is_there(self):
        import ast
        from boresight import _core as core

        stub = os.path.join(os.path.dirname(bs.__file__), "_core.pyi")
        with open(stub, encoding="utf-8") as file:
            tree = ast.parse(file.read())
        said = {}
        for node in tree.body:
            if isinstance(node, ast.ClassDef):
                said[node.name] = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                said[node.name] = None
        there = {name for name in vars(core) if not name.startswith("_")}
        self.assertEqual(set(said), there)
        for name, members in said.items():
            if members is not None:
                own = {n for n in vars(getattr(core, name)) if not n.startswith("_") or n in ("__call__", "__getitem__", "__setitem__", "__len__")}
                self.assertEqual({m for m in members if m != "__init__"}, own, name)
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(bs.__file__), "py.typed")))
        for name in bs.__all__:
            if name != "__version__":
                self.assertTrue(getattr(bs, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
