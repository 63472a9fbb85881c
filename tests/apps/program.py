# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the built program share: running and measuring it, and where data lie."""

import dataclasses
import hashlib
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
SOURCE = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("HYPERMAP_DATA", SOURCE / "../shared/data"))

# A sanitizer multiplies memory and time, so limits on them say nothing there.
IS_SANITIZED = any(mark in PROGRAM.read_bytes() for mark in (b"__asan_init", b"__tsan_init"))


def repetitions(full):
    """That many, or a quarter under a sanitizer: what only repeats itself takes fewer turns there."""
    return max(full // 4, 1) if IS_SANITIZED else full


def run(*arguments, stdout=subprocess.PIPE, env=None, limit_s=300):
    return subprocess.run([str(PROGRAM), *map(str, arguments)], stdout=stdout, stderr=subprocess.PIPE,
                          text=True, errors="replace", timeout=limit_s, env=env, check=False)


@dataclasses.dataclass
class Measured:
    """How one run of the program ended, and what it took."""

    returncode: int  # -n: ended by signal n
    stdout: str
    stderr: str
    cpu_s: float
    peak_bytes: int

    @property
    def error_lines(self):
        # The thread sanitizer's own helper complains when the limits of a test hit it too.
        return [line for line in self.stderr.splitlines()
                if line.strip() and not line.startswith("LLVMSymbolizer:")]


def run_measured(*arguments, limit_s=60, **options):
    """Like `run`, with the resources of this one child."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        with subprocess.Popen([str(PROGRAM), *map(str, arguments)], stdout=out, stderr=err,
                              **options) as child:
            watchdog = threading.Timer(limit_s, child.send_signal, [signal.SIGKILL])
            watchdog.start()
            _, status, usage = os.wait4(child.pid, 0)
            watchdog.cancel()
            child.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode(errors="replace"))
    return Measured(child.returncode, *texts, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def digest(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def tree_digest(folder):
    parts = [f"{p.relative_to(folder)}:{digest(p)}" for p in sorted(folder.rglob("*")) if p.is_file()]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()
