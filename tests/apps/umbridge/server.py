"""The program as a server, for as long as a test wants it."""

import http.client
import json
import os
import re
import signal
import subprocess

PROGRAM = os.environ["BORESIGHT_PROGRAM"]
EXAMPLES = os.environ["BORESIGHT_EXAMPLES"]


class Server:
    def __init__(self, *words):
        self.process = subprocess.Popen([PROGRAM, "serve", *words, "--port", "0"], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.said = ""
        for line in self.process.stdout:
            self.said += line
            if match := re.search(r"http://([0-9.]+):(\d+)", line):
                self.host, self.port = match[1], int(match[2])
                return
        raise RuntimeError(self.said + self.process.stderr.read())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.end()
        self.process.stdout.close()
        self.process.stderr.close()

    def end(self):
        """Ctrl-C; the exit status, and all that it said."""
        self.process.send_signal(signal.SIGINT)
        status = self.process.wait(timeout=60)
        self.said += self.process.stdout.read()  # what the wait for its address left there too
        return status, self.said, self.process.stderr.read()

    def connection(self):
        return http.client.HTTPConnection(self.host, self.port, timeout=60)

    def ask(self, endpoint, request=None, connection=None):
        """Status, answer, headers. request: text as it stands, or what becomes JSON; None: GET."""
        own = connection or self.connection()
        body = request if request is None or isinstance(request, (str, bytes)) else json.dumps(request)
        own.request("GET" if request is None else "POST", endpoint, body)
        answer = own.getresponse()
        found = answer.status, json.loads(answer.read()), answer.headers
        if connection is None:
            own.close()
        return found

    def value(self, point, connection=None):
        status, answer, _ = self.ask("/Evaluate", {"name": "index", "input": [list(point)], "config": {}}, connection)
        if status != 200:
            raise RuntimeError(answer)
        return answer["output"][0][0]
