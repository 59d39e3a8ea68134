"""boresight serve: the protocol, the limits, and that every answer is the one that was asked for."""

import csv
import os
import socket
import statistics
import subprocess
import tempfile
import threading
import time
import unittest

from server import EXAMPLES, PROGRAM, Server

MECHANISM = os.path.join(EXAMPLES, "3-rrcpr", "3-rrcpr.toml")
STUDY = os.path.join(EXAMPLES, "3-rrcpr", "montecarlo.toml")
QUICK = ("--rung", "perturbation", "--set", "motion.duration=20ms")
FOUR_BAR = os.path.join(EXAMPLES, "four-bar", "four-bar.toml")


def served():
    return Server(STUDY, *QUICK, "--jobs", "2")


def point(k):
    """One of as many points as one likes, all different."""
    return [0.5e-4 + 1e-4 * ((k * 0.6180339887498949) % 1.0), 0.7 + 0.25 * ((k * 0.7548776662466927) % 1.0), 0.02]


class Serve(unittest.TestCase):
    def test_tells_what_the_model_is(self):
        with served() as server:
            self.assertEqual(server.ask("/Info")[:2], (200, {"protocolVersion": 1.0, "models": ["index"]}))
            name = {"name": "index", "config": {}}
            self.assertEqual(server.ask("/InputSizes", name)[:2], (200, {"inputSizes": [3]}))
            self.assertEqual(server.ask("/OutputSizes", name)[:2], (200, {"outputSizes": [1]}))
            support = server.ask("/ModelInfo", name)[1]["support"]
            self.assertEqual(support, {"Evaluate": True, "Gradient": True, "ApplyJacobian": True, "ApplyHessian": False})
            self.assertIn("clearance.F1.radial [m]", server.end()[1])

    def test_evaluates_with_the_bits_of_a_study(self):
        with tempfile.TemporaryDirectory() as folder:
            short = os.path.join(folder, "study.toml")
            with open(STUDY, encoding="utf-8") as file:
                text = file.read().replace("samples = 2000", "samples = 40")
            with open(short, "w", encoding="utf-8") as file:
                file.write(text.replace('"3-rrcpr.toml"', f'"{MECHANISM}"'))
            # Lanes, and a rung whose samples share a step that was found for the whole scatter.
            for rung, rows in (("perturbation", 40), ("multibody", 3)):
                out = os.path.join(folder, rung)
                words = ["--rung", rung, "--set", "motion.duration=20ms"]
                subprocess.run([PROGRAM, "montecarlo", short, *words, "--out", out, "--quiet"], check=False)
                subprocess.run([PROGRAM, "export", out, "--quiet"], check=True)
                with open(os.path.join(out, "samples.csv"), encoding="utf-8") as file, Server(short, *words) as server:
                    samples = list(csv.DictReader(file))
                    self.assertEqual(len(samples), 40)
                    for row in samples[:rows]:
                        values = [float(row[name]) for name in row if name.startswith("clearance.")]
                        self.assertEqual(server.value(values), float(row["value"]))

    def test_refuses_what_is_no_request_in_words(self):
        with served() as server:
            good = {"name": "index", "input": [[1e-4, 0.9, 0.03]]}
            for endpoint, request, status, kind, says in (
                ("/Evaluate", "{", 400, "InvalidInput", "no JSON"),
                ("/Evaluate", b"\xff\xfe", 400, "InvalidInput", "no JSON"),
                ("/Evaluate", [], 400, "InvalidInput", "expected an object"),
                ("/Evaluate", {"input": [[1]]}, 400, "InvalidInput", "name"),
                ("/Evaluate", {**good, "name": "forward"}, 400, "ModelNotFound", "index"),
                ("/Evaluate", {"name": "index"}, 400, "InvalidInput", "input"),
                ("/Evaluate", {**good, "input": [[1e-4], [0.9]]}, 400, "InvalidInput", "one input vector"),
                ("/Evaluate", {**good, "input": [[1e-4, 0.9]]}, 400, "InvalidInput", "2 values"),
                ("/Evaluate", {**good, "input": [[1e-4, 0.9, "x"]]}, 400, "InvalidInput", "expected numbers"),
                ("/Evaluate", {**good, "input": [[-1e-4, 0.9, 0.03]]}, 400, "InvalidInput", "clearance.F1.radial"),
                ("/Evaluate", {**good, "input": [[1e-4, 1.5, 0.03]]}, 400, "InvalidInput", "restitution"),
                ("/Evaluate", '{"name":"index","input":[[NaN,0.9,0.03]]}', 400, "InvalidInput", "no JSON"),
                ("/Evaluate", '{"name":"index","input":[[1e999,0.9,0.03]]}', 400, "InvalidInput", "1e999"),
                ("/Evaluate", {**good, "config": {"rung": "multibody"}}, 400, "InvalidInput", "config"),
                ("/Gradient", {**good, "outWrt": 1, "inWrt": 0, "sens": [1]}, 400, "InvalidInput", "outWrt"),
                ("/ApplyJacobian", {**good, "outWrt": 0, "inWrt": 0, "vec": [1]}, 400, "InvalidInput", "vec"),
                ("/ApplyHessian", good, 400, "UnsupportedFeature", "second derivatives"),
                ("/Nothing", good, 404, "NotFound", "/Nothing"),
                ("/Nothing", None, 404, "NotFound", "GET /Nothing"),
            ):
                with self.subTest(endpoint=endpoint, request=request):
                    found, answer, _ = server.ask(endpoint, request)
                    self.assertEqual((found, answer["error"]["type"]), (status, kind), answer)
                    self.assertIn(says, answer["error"]["message"])
            self.assertGreater(server.value(good["input"][0]), 0.0)

    def test_refuses_bodies_that_are_too_long_and_goes_on(self):
        with served() as server:
            self.assertEqual(server.ask("/Evaluate", "x" * (1 << 21))[0], 413)
            # Without a length told before: in pieces.
            with socket.create_connection((server.host, server.port), timeout=60) as pieces:
                pieces.sendall(b"POST /Evaluate HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n")
                try:
                    for _ in range(64):
                        pieces.sendall(b"10000\r\n" + b"x" * 0x10000 + b"\r\n")
                    pieces.sendall(b"0\r\n\r\n")
                except OSError:
                    pass  # it has hung up
                try:
                    answer = pieces.recv(4096)
                except OSError:
                    answer = b""
            self.assertTrue(answer == b"" or b" 413 " in answer.split(b"\r\n")[0], answer)
            self.assertGreater(server.value(point(1)), 0.0)
            self.assertLess(self.memory_of(server), 200e6)

    @staticmethod
    def memory_of(server):
        with open(f"/proc/{server.process.pid}/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def test_outlives_connections_that_drop(self):
        with served() as server:
            server.value(point(0))
            files = f"/proc/{server.process.pid}/fd"
            before = len(os.listdir(files))
            for text in (b"POST /Evaluate HTTP/1.1\r\nContent-Length: 100\r\n\r\n{", b"GET", b"\r\n\r\n", b"\0" * 9000,
                         b"POST /Evaluate HTTP/1.1\r\nHost: x\r\nContent-Length: 63\r\n\r\n"
                         b'{"name": "index", "input": [[1e-4, 0.9, 0.03]], "config": {}  }'):
                for _ in range(8):
                    with socket.create_connection((server.host, server.port), timeout=60) as dropped:
                        dropped.sendall(text)
            self.assertEqual(server.value(point(1)), server.value(point(1)))
            end = time.monotonic() + 30.0
            while len(os.listdir(files)) > before and time.monotonic() < end:
                time.sleep(0.1)
            self.assertLessEqual(len(os.listdir(files)), before)  # none leaks
            self.assertEqual(server.end()[0], 0)

    def test_stops_a_motion_at_the_limit(self):
        with Server(MECHANISM, "--input", "payload.mass", "--rung", "multibody", "--set", "motion.duration=200s",
                    "--step", "1us", "--limit", "1 s", "--jobs", "1") as server:
            start = time.monotonic()
            status, answer, _ = server.ask("/Evaluate", {"name": "index", "input": [[10.0]]})
            self.assertEqual((status, answer["error"]["type"]), (503, "Stopped"))
            self.assertLess(time.monotonic() - start, 30.0)

    def test_stops_slopes_at_the_limit(self):
        with Server(FOUR_BAR, "--input", "clearance.D.radial", "--index", "position_error.rms", "--rung", "perturbation",
                    "--set", "motion.duration=4s", "--limit", "20 ms", "--jobs", "1") as server:
            request = {"name": "index", "input": [[1e-4]], "outWrt": 0, "inWrt": 0}
            for endpoint, by in (("/Gradient", {"sens": [2.0]}), ("/ApplyJacobian", {"vec": [3.0]})):
                status, answer, _ = server.ask(endpoint, {**request, **by})
                self.assertEqual((status, answer["error"]["type"]), (503, "Stopped"), (endpoint, answer))
                self.assertIn("longer than the server allows", answer["error"]["message"])

    def test_ends_on_a_signal_with_everybody_answered(self):
        with Server(MECHANISM, "--input", "payload.mass", "--rung", "multibody", "--set", "motion.duration=1000s",
                    "--step", "1us", "--jobs", "2") as server:
            answers = []
            askers = [threading.Thread(target=lambda: answers.append(
                server.ask("/Evaluate", {"name": "index", "input": [[10.0]]})[0])) for _ in range(2)]
            for asker in askers:
                asker.start()
            time.sleep(1.0)
            status, said, err = server.end()
            for asker in askers:
                asker.join()
            self.assertEqual((status, err), (0, ""))
            self.assertEqual(answers, [503, 503])
            self.assertIn("0 requests answered, 2 refused", said)

    def test_is_open_to_this_machine_alone(self):
        with served() as server:
            self.assertEqual(server.host, "127.0.0.1")
            self.assertNotIn("warning", server.said)
            with self.assertRaises(OSError):  # of the same machine, by another address than the one it listens on
                socket.create_connection(("127.0.0.2", server.port), timeout=5)

    def test_does_not_share_its_port_with_another(self):
        with served() as server:
            second = subprocess.run([PROGRAM, "serve", FOUR_BAR, "--input", "clearance.D.radial", "--port",
                                     str(server.port)], capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual(second.returncode, 3, second.stderr)
            self.assertIn("it is taken", second.stderr)

    def test_gives_gradients_where_there_are_such(self):
        with Server(FOUR_BAR, "--input", "clearance.D.radial", "--rung", "quasistatic") as server:
            request = {"name": "index", "input": [[1e-4]], "outWrt": 0, "inWrt": 0, "sens": [2.0]}
            status, answer, _ = server.ask("/Gradient", request)
            self.assertEqual((status, answer["error"]["type"]), (400, "UnsupportedFeature"))
            self.assertIn("perturbation", answer["error"]["message"])
        # A journal that stays in contact: slopes hold, and are those of neighbouring motions.
        with Server(FOUR_BAR, "--input", "clearance.D.radial", "--index", "position_error.rms", "--rung", "perturbation",
                    "--integrator", "rosenbrock", "--tolerance", "1e-6", "--set", "motion.duration=20ms") as server:
            radial = 1e-4
            request = {"name": "index", "input": [[radial]], "outWrt": 0, "inWrt": 0}
            status, answer, _ = server.ask("/Gradient", {**request, "sens": [2.0]})
            self.assertEqual(status, 200, answer)
            slope = answer["output"][0] / 2.0
            difference = (server.value([1.001 * radial]) - server.value([0.999 * radial])) / (0.002 * radial)
            self.assertAlmostEqual(slope / difference, 1.0, delta=0.02)
            along = server.ask("/ApplyJacobian", {**request, "vec": [3.0]})[1]["output"]
            self.assertEqual(along, [3.0 * slope])

    def test_adds_less_than_a_millisecond_to_a_motion(self):
        with served() as server:
            connection = server.connection()
            beside = []
            for k in range(400):
                start = time.perf_counter()
                headers = server.ask("/Evaluate", {"name": "index", "input": [point(k)]}, connection)[2]
                seconds = time.perf_counter() - start
                beside.append(1e3 * seconds - float(headers["Server-Timing"].split("dur=")[1]))
            connection.close()
            beside.sort()
            print(f"beside the motion: median {statistics.median(beside):.3f} ms, least {beside[0]:.3f} ms")
            # The machine may be busy with other things: those that were not held up show what the server takes.
            self.assertLess(beside[len(beside) // 4], 1.0)

    def test_long_answers_ten_thousand_over_eight_connections_each_its_own(self):
        count, connections = 10_000, 8
        with served() as server:
            found = [None] * count

            def ask(first):
                connection = server.connection()
                for k in range(first, count, connections):
                    found[k] = server.value(point(k), connection)
                connection.close()

            askers = [threading.Thread(target=ask, args=(first,)) for first in range(connections)]
            for asker in askers:
                asker.start()
            for asker in askers:
                asker.join()
            self.assertNotIn(None, found)
            # Each again, alone: an answer that went to another question would not be its own.
            connection = server.connection()
            for k in range(0, count, 50):
                self.assertEqual(found[k], server.value(point(k), connection))
            connection.close()
            self.assertGreater(len(set(found)), count - 10)
            _, said, _ = server.end()
            self.assertIn(f"{count + count // 50} requests answered, 0 refused", said)
            print(f"{count} evaluations over {connections} connections, none lost or mixed up")


if __name__ == "__main__":
    unittest.main()
