# SPDX-License-Identifier: BSD-3-Clause
"""Faults of the system at a chosen call of the program: how they are made, and what must hold after each."""

import errno
import hashlib
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from program import PROGRAM, digest, run, tree_digest

PRELOADED = os.environ["HYPERMAP_FAULTS_PRELOAD"]
# All of them take minutes; else a sample that is the same every time.
ALL = "HYPERMAP_ALL_FAULTS" in os.environ

KILL = "kill"
HIDDEN = ".hypermap-save-"
OLD = b"what was there before"

# What a call may fail for.
_PLACE = (errno.EIO, errno.EACCES)
REASONS = {"open": (*_PLACE, errno.EMFILE, errno.EINTR), "create": (*_PLACE, errno.EMFILE, errno.EINTR, errno.ENOSPC),
           "read": (errno.EIO, errno.EINTR), "write": (errno.EIO, errno.EINTR, errno.ENOSPC),
           "close": (errno.EIO, errno.EINTR), "fsync": (errno.EIO, errno.ENOSPC), "fchmod": (errno.EIO,),
           "fchown": (errno.EIO,), "stat": _PLACE, "mkdir": (*_PLACE, errno.ENOSPC),
           "mkdtemp": (*_PLACE, errno.ENOSPC), "rename": (*_PLACE, errno.ENOSPC), "remove": _PLACE}


def with_fault(command, below, working, fault=None, log=None, prefix=()):
    """Runs the program with a fault (number, reason) at its calls on what lies below that folder, in another one."""
    env = dict(os.environ, LD_PRELOAD=PRELOADED, HYPERMAP_FAULTS_IN=str(below), TMPDIR=str(working))
    if fault is not None:
        env["HYPERMAP_FAULT"] = f"{fault[0]} {fault[1]}"
    if log is not None:
        env["HYPERMAP_FAULTS_LOG"] = str(log)
    return subprocess.run([*prefix, str(PROGRAM), *map(str, command)], env=env, cwd=working, capture_output=True,
                          text=True, errors="replace", timeout=300, check=False)


def sampled(name, faults, count):
    """So many of them, scattered; those by another name are others."""
    if ALL or len(faults) <= count:
        return faults
    return sorted(faults, key=lambda fault: hashlib.sha1(f"{name} {fault}".encode()).digest())[:count]


class FaultCase(unittest.TestCase):
    """Commands that write into the folder `out`; each test has its own, which `prepare` fills before each run."""

    REPLACES_ONE = True  # each piece is one file or folder
    KEEPS_OLD = False  # what was replaced stays in a temporary until its successor is on the disk
    is_repeatable = True  # the command gives the same a second time

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-faults-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.out = self.folder / "out"
        self.working = self.folder / "working"
        self.working.mkdir()

    def pieces(self):
        """What must be old or new as a whole: each file that is not hidden, by name."""
        return {path.name: self.content(path) for path in self.out.iterdir() if not path.name.startswith(HIDDEN)}

    def content(self, path):
        return digest(path) if path.is_file() else tree_digest(path)

    def is_allowed(self, name):
        """Whether a file may be there that neither the old nor the new state has."""
        return False

    def fill(self, prepare):
        shutil.rmtree(self.out, ignore_errors=True)
        self.out.mkdir()
        prepare()

    def hidden(self):
        return [name for name in os.listdir(self.out) if name.startswith(HIDDEN)]

    def check_faults(self, prepare, command, count, below=None, prefix=()):
        """The command under `count` faults (0: all) at its calls below the folder; usual: the folder that is written."""
        below = below or self.out
        self.fill(prepare)
        self.old = self.pieces()
        log = self.folder / "calls"
        log.unlink(missing_ok=True)
        usual = with_fault(command, below, self.working, log=log)
        self.assertIn(usual.returncode, (0, 1), usual.stderr)
        self.usual = usual.returncode
        self.new = self.pieces()
        self.assertNotEqual(self.old, self.new)
        calls = [line.split(" ", 1)[0] for line in log.read_text().splitlines()]
        faults = [(number, reason) for number, call in enumerate(calls, 1) for reason in (*REASONS[call], KILL)]
        for number, reason in sampled(command[0], faults, count or len(faults)):
            label = reason if reason == KILL else errno.errorcode[reason]
            with self.subTest(command=command[0], call=calls[number - 1], number=number, reason=label):
                self.fill(prepare)
                result = with_fault(command, below, self.working, (number, reason), prefix=prefix)
                self.check_after(result, calls[number - 1], reason)
                if reason == KILL or self.hidden():
                    self.check_next(command, prefix)

    def check_after(self, result, call, reason):
        self.check_pieces(result)
        if reason == KILL:
            self.assertIn(result.returncode, (-9, 137), result.stderr)
            return
        may_stay = ("remove", "open", "close", "stat")  # with these temporaries are removed
        if call not in may_stay and not (self.KEEPS_OLD and call == "fsync"):
            self.assertEqual(self.hidden(), [])
        self.assertIn(result.returncode, (self.usual, 1, 3), result.stderr)
        is_new = all(self.pieces().get(name) == content for name, content in self.new.items())
        if result.returncode == 3:
            self.check_error(result, reason, is_new)
            return
        self.assertTrue(is_new, "success without the new files")
        if result.returncode != self.usual:  # what was left out is said
            self.assertRegex(result.stderr, f"warning: .*{os.strerror(reason)}")

    def check_error(self, result, reason, is_new):
        lines = [line for line in result.stderr.splitlines() if line.startswith("hypermap: ")]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertIn(os.strerror(reason), lines[0])
        self.assertIn(str(self.folder), lines[0])
        if self.REPLACES_ONE and len(self.new) == 1:
            self.assertEqual("replaced" in lines[0], is_new, lines[0])

    def check_pieces(self, result):
        for name, content in self.pieces().items():
            if name in self.old or name in self.new:
                self.assertIn(content, (self.old.get(name), self.new.get(name)), f"{name} is torn: {result.stderr}")
            else:
                self.assertTrue(self.is_allowed(name), f"{name} is left: {result.stderr}")
        for name in self.old:
            self.assertTrue((self.out / name).exists(), f"{name} is lost: {result.stderr}")

    def check_next(self, command, prefix):
        """The next run succeeds and leaves no trace of the last."""
        is_new_expected = self.is_repeatable or self.pieces() == self.old
        result = with_fault(command, self.out, self.working, prefix=prefix)
        self.assertEqual(result.returncode, self.usual, result.stderr)
        now = self.pieces()
        if is_new_expected:
            self.assertEqual({name: now.get(name) for name in self.new}, self.new)
        self.assertEqual(self.hidden(), [])
