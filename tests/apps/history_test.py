#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Other times than now: what was seen in a span or a session, and what was believed at a moment, against maps that
ended then.

Usage: history_test.py PROGRAM [unittest args]"""

import json
import pathlib
import shutil
import tempfile
import unittest

from program import run

PASS_FRAMES = 30  # of each of two passes
MORNING = ("--max-frames", PASS_FRAMES, "--session", "morning")
EVENING = ("--first", PASS_FRAMES, "--append", "--same-world", "--session", "evening")


class History(unittest.TestCase):
    """A laboratory in two passes, four things removed and four added between them, mapped as two sessions."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="hypermap-history-"))
        cls.dataset = cls.folder / "lab"
        cls.map = cls.folder / "lab.hmap"
        common = ("map", "--input", cls.dataset, "--resolution", 0.1)
        cls.steps = [run("simulate", "--frames", PASS_FRAMES, "--passes", 2, "--removed", 4, "--added", 4, "--seed", 1,
                         "--size", "320x240", "--detector", "perfect", "--output", cls.dataset),
                     run(*common, "--output", cls.map, *MORNING)]
        cls.morning = cls.folder / "morning.hmap"
        shutil.copy(cls.map, cls.morning)
        cls.steps.append(run(*common, "--output", cls.map, *EVENING))
        cls.half = cls.folder / "half.hmap"
        cls.steps.append(run(*common, "--output", cls.half, "--max-frames", PASS_FRAMES // 2))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        for step in self.steps:
            self.assertIn(step.returncode, (0, 1), step.stderr)

    def done(self, *arguments, status=0):
        result = run(*arguments)
        self.assertEqual(result.returncode, status, f"{arguments}: {result.stdout}{result.stderr}")
        return result

    def told(self, archive, *conditions):
        return json.loads(self.done("query", archive, *conditions, "--json").stdout)

    def ids(self, archive, *conditions):
        return {one["id"] for one in self.told(archive, *conditions)["results"]}

    def sessions(self, archive):
        return json.loads(self.done("info", archive, "--json").stdout)["sessions"]

    def test_info_lists_the_sessions_with_their_times(self):
        morning, evening = self.sessions(self.map)
        self.assertEqual((morning["name"], evening["name"]), ("morning", "evening"))
        self.assertEqual((morning["number"], morning["input"]), (1, "lab"))
        self.assertLess(morning["first_s"], morning["last_s"])
        self.assertLess(morning["last_s"], evening["first_s"])
        self.assertRegex(self.done("info", self.map).stdout, r"session morning: [\d.]+ s to [\d.]+ s, from lab\n")

    def test_the_end_of_the_first_session_is_the_map_that_ended_then(self):
        end = self.sessions(self.morning)[0]["last_s"]
        then = self.told(self.map, "--as-of", end)
        believed = {one["id"]: one for one in then["results"]}
        truth = {one["id"]: one for one in self.told(self.morning, "--layer", "objects")["results"]}
        unknown = {one["id"] for one in then["unknown"]}
        self.assertGreater(len(truth), 5)
        # Objects that merged or were removed in the second pass are no longer known; all others are as they were.
        lost = set(truth) - set(believed) - unknown
        self.assertEqual(lost & {one["id"] for one in self.told(self.map, "--layer", "objects")["results"]}, set())
        self.assertLessEqual(len(lost), 2)
        self.assertEqual(set(believed) - set(truth), set())
        for one in believed.values():
            was = truth[one["id"]]
            self.assertEqual(one["name"], was["name"])
            self.assertAlmostEqual(one["real_probability"], was["real_probability"], places=4)
            self.assertAlmostEqual(one["last_seen_s"], was["last_seen_s"])
        self.assertEqual(self.ids(self.map, "--as-of", end, "--session", "morning"), set(believed))
        self.assertEqual(self.ids(self.map, "--as-of", end, "--layer", "semantic", "--string", "/.*/"), set(believed))

    def test_the_middle_of_the_first_session_too(self):
        end = self.sessions(self.half)[0]["last_s"]
        then = self.told(self.morning, "--as-of", end)
        self.assertEqual(then["unknown"], [], "thirty frames are all kept")
        believed = {one["id"]: one["name"] for one in then["results"]}
        truth = {one["id"]: one["name"] for one in self.told(self.half, "--layer", "objects")["results"]}
        self.assertLess(len(truth), len(self.ids(self.morning, "--layer", "objects")))
        self.assertLessEqual(len(set(truth) ^ set(believed)), 1)
        for number in set(truth) & set(believed):
            self.assertEqual(believed[number], truth[number])

    def test_the_last_time_is_now(self):
        end = self.sessions(self.map)[1]["last_s"]
        now = self.told(self.map, "--layer", "objects")["results"]
        then = self.told(self.map, "--as-of", end)
        self.assertEqual([one["id"] for one in then["results"]], [one["id"] for one in now])
        self.assertEqual([one["confidence"] for one in then["results"]], [one["confidence"] for one in now])
        self.assertEqual(then["unknown"], [])

    def test_sessions_and_spans(self):
        now = self.ids(self.map, "--layer", "objects")
        morning = self.ids(self.map, "--session", "morning")
        evening = self.ids(self.map, "--session", "evening")
        self.assertEqual(morning | evening, now)
        self.assertGreaterEqual(len(evening - morning), 3, "things that were added")
        first, last = self.sessions(self.map)[0]["last_s"], self.sessions(self.map)[1]["first_s"]
        self.assertEqual(self.ids(self.map, "--until", first), morning)
        self.assertEqual(self.ids(self.map, "--since", last), evening)
        self.assertEqual(self.ids(self.map, "--session", "evening", "--since", last), evening)
        half = (first + last) / 2
        self.assertEqual(self.ids(self.map, "--since", 0, "--until", half) | self.ids(self.map, "--since", half), now)
        for one in self.told(self.map, "--until", first)["results"]:
            self.assertLessEqual(one["first_seen_s"], first)

    def test_what_is_gone_was_believed_before(self):
        end = self.sessions(self.map)[0]["last_s"]
        gone = self.ids(self.map, "--as-of", end) - self.ids(self.map, "--layer", "objects")
        self.assertGreaterEqual(len(gone), 3, "things that were removed")
        self.assertGreaterEqual(self.told(self.map, "--session", "morning")["unconfirmed"], len(gone))
        for number in gone:
            why = json.loads(self.done("query", self.map, "--why", number, "--as-of", end, "--json").stdout)
            self.assertTrue(why["shown"])
            self.assertFalse(json.loads(self.done("query", self.map, "--why", number, "--json").stdout)["shown"])

    def test_other_conditions_go_with_it(self):
        end = self.sessions(self.map)[0]["last_s"]
        chairs = self.told(self.map, "--string", "chair", "--as-of", end)["results"]
        self.assertTrue(chairs)
        self.assertEqual({one["name"] for one in chairs}, {"chair"})
        nearest = self.told(self.map, "--nearest", "chair", "--at", "0,0", "--as-of", end)["results"]
        self.assertIn(nearest[0]["id"], {one["id"] for one in chairs})

    def test_the_answer_says_what_is_not_kept(self):
        text = self.done("query", self.map, "--as-of", 3).stdout
        self.assertRegex(text, r"as of 3\.0 s: as believed then, with the shapes of now; not kept through time: occupancy")
        told = self.told(self.map, "--as-of", 3)
        self.assertEqual(told["time"], {"as_of_s": 3.0, "since_s": None, "until_s": None, "session": None})
        self.assertIn("occupancy", told["not_kept"])
        self.assertIn("octrees", told["not_kept"])

    def test_before_the_first_frame_nothing_is_there(self):
        first = self.sessions(self.map)[0]["first_s"]
        before = max(first - 1, 0)
        self.assertEqual(self.told(self.map, "--until", before)["results"] if before < first else [], [])
        late = self.done("query", self.map, "--since", 1e6)
        self.assertIn("0 found", late.stdout)
        self.assertIn("the map's frames are from", late.stderr)
        late = self.done("query", self.map, "--nearest", "chair", "--at", "0,0", "--since", 1e6, status=2)
        self.assertIn("from 1000000.0 s on", late.stderr)

    def test_wrong_questions(self):
        for status, words, conditions in [
                (4, "must be seconds (12.5) or a date", ("--as-of", "noon")),
                (4, "must be seconds (12.5) or a date", ("--since", "nan")),
                (4, "must not be after --until 1", ("--since", 2, "--until", 1)),
                (4, "is a moment", ("--as-of", 2, "--until", 1)),
                (4, "--layer occupancy is not kept through time", ("--as-of", 2, "--layer", "occupancy")),
                (4, "space is not kept through time", ("--as-of", 2, "--rooms")),
                (4, "space is not kept through time",
                 ("--as-of", 2, "--nearest", "chair", "--at", "0,0", "--free-space")),
                (4, "--why asks of a moment", ("--since", 2, "--why", 1)),
                (4, "--embedding goes without --as-of", ("--as-of", 2, "--embedding", "x.npy")),
                (4, "must be seconds of the map's own clock", ("--as-of", "2012-07-09T13:41:18Z")),
                (2, "no session 'noon'; it has morning (", ("--session", "noon")),
                (2, "no session '1'", ("--session", 1))]:
            with self.subTest(conditions):
                self.assertIn(words, self.done("query", self.map, *conditions, status=status).stderr)

    def test_a_name_is_that_of_one_session(self):
        copy = self.folder / "copy.hmap"
        shutil.copy(self.morning, copy)
        again = ("map", "--input", self.dataset, "--output", copy, "--first", PASS_FRAMES, "--append", "--same-world")
        refused = self.done(*again, "--session", "morning", status=2)
        self.assertIn("the map has a session of that name; it has morning (", refused.stderr)
        self.assertIn("must be no number", self.done(*again, "--session", "7", status=4).stderr)


if __name__ == "__main__":
    unittest.main()
