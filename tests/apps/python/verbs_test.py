"""The verbs as functions, and one study by all three ways in."""

import csv
import os
import re
import subprocess
import sys
import tempfile
import threading
import unittest

import boresight as bs
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "umbridge"))
from server import Server

EXAMPLES = os.environ["BORESIGHT_EXAMPLES"]
PROGRAM = os.environ["BORESIGHT_PROGRAM"]
MECHANISM = os.path.join(EXAMPLES, "3-rrcpr", "3-rrcpr.toml")
STUDY = os.path.join(EXAMPLES, "3-rrcpr", "montecarlo.toml")
SHORT = {"motion.duration": "20 ms"}


class Python(unittest.TestCase):
    def study_in(self, folder, samples):
        path = os.path.join(folder, "study.toml")
        with open(STUDY, encoding="utf-8") as file:
            text = file.read().replace("samples = 2000", f"samples = {samples}").replace('"3-rrcpr.toml"', f'"{MECHANISM}"')
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def samples_of(self, folder):
        subprocess.run([PROGRAM, "export", folder, "--quiet"], check=True)
        with open(os.path.join(folder, "samples.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        paths = [name for name in rows[0] if name.startswith("clearance.")]
        return (numpy.array([[float(row[path]) for path in paths] for row in rows]),
                numpy.array([float(row["value"]) for row in rows]))

    def test_a_study_has_the_same_bits_from_command_line_python_and_umbridge(self):
        with tempfile.TemporaryDirectory() as folder:
            study = self.study_in(folder, 24)
            for rung, count in (("perturbation", 24), ("multibody", 3)):
                out = os.path.join(folder, rung)
                subprocess.run([PROGRAM, "montecarlo", study, "--rung", rung, "--set", "motion.duration=20ms", "--out", out,
                                "--quiet"], check=False)
                x, values = self.samples_of(out)
                f = bs.Function.from_file(study, rung=rung, settings=SHORT)
                numpy.testing.assert_array_equal(f.batch(x).values, values)
                with Server(study, "--rung", rung, "--set", "motion.duration=20ms") as server:
                    served = [server.value(one) for one in x[:count]]
                self.assertEqual(served, list(values[:count]))
                ours = bs.montecarlo(study, rung=rung, settings=SHORT, out=os.path.join(folder, rung + "-python"))
                numpy.testing.assert_array_equal(self.samples_of(ours.folder)[1], values)
                print(f"{rung}: command line, Python (study and function) and UM-Bridge agree in all bits of {count} values")

    def test_a_mechanism_is_imported_and_converted(self):
        with tempfile.TemporaryDirectory() as folder:
            to = os.path.join(folder, "gimbal.toml")
            bs.import_mechanism(os.path.join(EXAMPLES, "from-urdf", "gimbal.urdf"), to, boresight="optical_frame:z", drive="pan=t; tilt")
            m = bs.Mechanism(to)
            self.assertEqual(m.name, "camera gimbal")
            with self.assertRaises(bs.ResultsError):
                bs.import_mechanism(os.path.join(EXAMPLES, "from-urdf", "gimbal.urdf"), to)
            bs.convert(to, os.path.join(folder, "gimbal.sdf"))
            bs.import_mechanism(os.path.join(folder, "gimbal.sdf"), os.path.join(folder, "again.toml"))
            with open(os.path.join(folder, "bad.urdf"), "w", encoding="utf-8") as file:
                file.write("<robot name='r'>\n<link/></robot>")
            with self.assertRaises(bs.InputError) as caught:
                bs.import_mechanism(os.path.join(folder, "bad.urdf"), os.path.join(folder, "bad.toml"))
            self.assertEqual((caught.exception.line, caught.exception.key), (2, "link.name"))

    def test_a_verb_without_a_summary_answers_with_its_own_folder(self):
        study = os.path.join(EXAMPLES, "3-rrcpr", "montecarlo.toml")
        with tempfile.TemporaryDirectory() as folder:
            first, other, to = (os.path.join(folder, name) for name in ("a", "b", "csv"))
            bs.montecarlo(study, settings=SHORT, rung="envelope", out=first)
            bs.montecarlo(study, settings=SHORT, rung="quasistatic", out=other)
            exported = bs.verb("export", first, out=to)
            self.assertEqual(os.path.realpath(exported.folder), os.path.realpath(to))
            self.assertEqual(exported.summary, {})

    def test_each_verb_is_called_with_the_options_that_it_has(self):
        def printed(*arguments):
            code = "import sys, boresight; boresight.verb(*sys.argv[1:])"
            done = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done.stdout

        self.assertIn("clearance.F1.radial", printed("paths", MECHANISM))
        self.assertIn('"$schema"', printed("schema", "study"))
        self.assertIn("restitution", printed("help", "restitution"))
        with tempfile.TemporaryDirectory() as folder:
            new = bs.verb("new", os.path.join(folder, "antenna"))
            self.assertIn("mechanism.toml", new.files)
            run = bs.check(MECHANISM, out=os.path.join(folder, "check"))
            again = bs.verb("report", run.folder)
            self.assertEqual((again.folder, again.summary), (run.folder, run.summary))
        self.assertEqual((bs.Result("paths", 0, "").files, bs.Result("paths", 0, "").summary), ([], {}))
        self.assertIn("paths", bs.Result("paths", 0, "")._repr_html_())
        with self.assertRaisesRegex(bs.InputError, "--out"):
            bs.verb("paths", MECHANISM, out="nowhere")
        with self.assertRaises(bs.InputError):
            bs.verb("path", MECHANISM)

    def test_a_start_beyond_the_motion_is_refused(self):
        m = bs.Mechanism(os.path.join(EXAMPLES, "four-bar", "four-bar.toml"))
        with self.assertRaises(bs.InputError):
            bs.run(m, rung="envelope", start=50.0)

    def test_the_example_from_urdf_ends_with_a_budget(self):
        with tempfile.TemporaryDirectory() as folder:
            ran = self.example("gimbal_from_urdf.py", folder)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.assertRegex(ran.stdout, r"APE at 95%: \d+ arcsec")
            self.assertIn("mounting", ran.stdout)
            self.assertTrue(os.path.exists(os.path.join(folder, "report.html")))
            with open(os.path.join(folder, "gimbal.toml"), encoding="utf-8") as made, \
                    open(os.path.join(EXAMPLES, "from-urdf", "gimbal.toml"), encoding="utf-8") as kept:
                self.assertEqual(made.read(), kept.read())
            print(ran.stdout)

    def test_the_example_of_calibration_plots_what_it_fitted(self):
        with tempfile.TemporaryDirectory() as folder:
            plot = os.path.join(folder, "plot.html")
            ran = self.example("calibration.py", plot)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            # The truth of the example's data is in the interval, and near the value: three errors of what the data alone know, 0.11 %.
            found = re.search(r"clearance.D.contact.restitution: (\S+) \((\S+) to (\S+)\)", ran.stdout)
            value, low, high = (float(found[i]) for i in (1, 2, 3))
            self.assertAlmostEqual(value, 0.6, delta=0.002)
            self.assertTrue(low < 0.6 < high, found[0])
            with open(plot, encoding="utf-8") as file:
                self.assertIn("fitted", file.read())
            print(ran.stdout)

    def example(self, name, *arguments):
        return subprocess.run([sys.executable, os.path.join(EXAMPLES, "python", name), *arguments], capture_output=True,
                              text=True, check=False, timeout=280)

    def test_a_result_has_summary_report_tables_and_a_face(self):
        with tempfile.TemporaryDirectory() as folder:
            result = bs.montecarlo(self.study_in(folder, 30), rung="quasistatic", settings=SHORT)
            self.assertEqual(result.summary["samples"], 30)
            self.assertEqual(result.answer, result.status == 0)
            path = result.report(os.path.join(folder, "report.html"))
            with open(path, encoding="utf-8") as file:
                self.assertIn("<html", file.read(2000))
            self.assertIn("<table>", result._repr_html_())
            own = result.folder
            self.assertTrue(os.path.exists(own))
            del result
            self.assertFalse(os.path.exists(own))
            motion = bs.report_of_run(MECHANISM, settings=SHORT, rung="quasistatic", step_error="off")
            table = motion.table("timeseries.csv")
            self.assertEqual(table.dtype.names[:4], ("t", "dx", "dy", "dz"))
            self.assertTrue(all(table.dtype[name].kind in "fi" for name in ("t", "dx")))
            self.assertEqual(len(table["t"]), len(set(table["t"])))
            # Text with commas, which the file quotes.
            with open(os.path.join(motion.folder, "texts.csv"), "w", encoding="utf-8") as file:
                file.write('name,says,value,so\na,"one, two",1,true\nb,"a ""word""",,false\n')
            texts = motion.table("texts.csv")
            self.assertEqual(list(texts["says"]), ["one, two", 'a "word"'])
            self.assertEqual(texts["value"][0], 1.0)
            self.assertEqual(list(texts["so"]), [True, False])
            run = bs.run(bs.Mechanism(MECHANISM, SHORT), rung="quasistatic", sample=1e-3)
            self.assertEqual(motion.summary["index"], run.index)

    def test_every_verb_with_results_is_a_function(self):
        listed = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True).stdout
        verbs = {line.split()[0] for line in listed.splitlines() if line.startswith("  ") and line[2:3].islower()}
        not_studies = {"new", "import", "run", "report", "export", "serve", "paths", "help", "schema", "completion"}
        self.assertTrue(not_studies <= verbs, verbs)
        for name in verbs - not_studies:
            self.assertTrue(callable(getattr(bs, name, None)), name)
        self.assertIn("contact_laws", bs.laws().summary)
        self.assertIn("mobility", str(bs.check(MECHANISM).summary))

    def test_what_is_wrong_is_an_exception(self):
        with self.assertRaises(bs.InputError) as caught:
            bs.montecarlo(STUDY, settings={"clearance.F1.radia": "0.1 mm"})
        self.assertIn("did you mean clearance.F1.radial", str(caught.exception))
        with self.assertRaises(bs.InputError):
            bs.montecarlo(STUDY, no_such_option=1)
        with self.assertRaises(bs.InputError):
            bs.check("nowhere.toml")
        with tempfile.TemporaryDirectory() as folder:
            out = os.path.join(folder, "out")
            bs.check(MECHANISM, out=out)
            with self.assertRaises(bs.ResultsError):
                bs.check(os.path.join(EXAMPLES, "four-bar", "four-bar.toml"), out=out)

    def test_a_study_tells_its_progress_and_goes_on_where_it_was_stopped(self):
        class Enough(Exception):
            pass

        with tempfile.TemporaryDirectory() as folder:
            study, out = self.study_in(folder, 4000), os.path.join(folder, "out")
            told = []

            def progress(done, total, unit, estimate):
                told.append((done, total, unit))
                if unit == "samples" and done > 0:
                    raise Enough

            with self.assertRaises(Enough):
                bs.montecarlo(study, rung="multibody", settings=SHORT, out=out, progress=progress)
            self.assertIn((4000.0, "samples"), [(total, unit) for _, total, unit in told])
            self.assertTrue(bs.Result("montecarlo", 0, out).summary["interrupted"])

    def test_verbs_from_several_threads_take_turns(self):
        found = []
        threads = [threading.Thread(target=lambda: found.append(bs.laws().summary["contact_laws"].keys())) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), 3)
        self.assertTrue(all(keys == found[0] for keys in found))


if __name__ == "__main__":
    unittest.main()
