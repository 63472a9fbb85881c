#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the program says of an object's class: outside knowledge (`query --why`), and the runner-up.

Usage: why_test.py PROGRAM [unittest args]"""

import json
import math
import unittest
import zipfile

from laboratory import SmallLaboratoryCase
from program import run


class Why(SmallLaboratoryCase):
    def objects(self):
        return json.loads(run("query", self.map, "--layer", "objects", "--json").stdout)["results"]

    def most_and_least_believed(self, thing):
        """Ids of classes of an object."""
        with zipfile.ZipFile(self.map) as members:
            lines = map(json.loads, members.read("objects.jsonl").decode().splitlines())
            entries = next(one for one in lines if one.get("id") == thing)["belief"]["classes"]
        return max(entries, key=lambda entry: entry[1])[0], min(entries, key=lambda entry: entry[1])[0]

    def told_of(self, thing, change):
        """The JSON and the lines of the map in which the object's line of JSON is changed."""
        changed = self.folder / "changed.hmap"
        with zipfile.ZipFile(self.map) as old, zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as new:
            for name in old.namelist():
                content = old.read(name)
                if name == "objects.jsonl":
                    lines = [json.loads(line) for line in content.decode().splitlines()]
                    change(next(one for one in lines if isinstance(one, dict) and one.get("id") == thing))
                    content = "".join(json.dumps(line) + "\n" for line in lines).encode()
                new.writestr(name, content)
        answer = run("query", changed, "--why", thing, "--json")
        self.assertEqual(answer.returncode, 0, answer.stderr)
        lines = run("query", changed, "--why", thing).stdout.splitlines()
        return json.loads(answer.stdout), lines

    def told(self, thing, prior):
        """The JSON of the map in which the object has that prior, and the lines about it."""
        why, lines = self.told_of(thing, lambda one: one.update(prior=prior))
        return why, [line for line in lines if line.startswith("  prior ")]

    def test_an_observation_tells_what_it_changed(self):
        """The newest entry is made a detection of a class, with changes that are known."""
        thing = self.objects()[0]["id"]

        def change(one):
            entry = one["ledger"]["newest"][-1]
            entry[2:] = [0, 1, 0, 3, 0.5, 0.0, 2.0, 0.75, 1.234, [[5, -0.413], [1, 0.2]]]

        names = [one["name"] for one in json.loads(run("info", self.map, "--json").stdout)["classes"]]
        why, lines = self.told_of(thing, change)
        newest = why["log"][-1]
        self.assertEqual(newest["class"], names[3])
        self.assertAlmostEqual(newest["belief_change"], 1.234, places=6)
        self.assertEqual([one["class"] for one in newest["other_changes"]], [names[5], names[1]])
        for one, by in zip(newest["other_changes"], (-0.413, 0.2), strict=True):
            self.assertAlmostEqual(one["belief_change"], by, places=6)
        at = next(i for i, line in enumerate(lines) if line.startswith("  last seen"))
        self.assertEqual(lines[at + 1].strip(), f"in log-odds: existence 0.75 more, {names[3]} 1.23 more, "
                                                f"and {names[5]} 0.41 less, {names[1]} 0.20 more")

    def test_wrong_changes_are_refused_by_member_and_path(self):
        changed = self.folder / "wrong.hmap"
        with zipfile.ZipFile(self.map) as old, zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as new:
            for name in old.namelist():
                content = old.read(name).decode("latin-1")
                if name == "objects.jsonl":
                    lines = content.splitlines()
                    one = json.loads(lines[1])
                    one["ledger"]["first"][11:] = [[[5, "much"]]]
                    content = "\n".join([lines[0], json.dumps(one), *lines[2:]]) + "\n"
                new.writestr(name, content.encode("latin-1"))
        refused = run("query", changed, "--why", 1)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("objects.jsonl:2: $.ledger.first[11][0][1]", refused.stderr)

    def test_outside_knowledge_is_told_where_there_is_any(self):
        """[smap] Eq. (3.17): the class times e^-2, another one times e^2, so e^4 against it."""
        thing = self.objects()[0]
        best, other = self.most_and_least_believed(thing["id"])
        self.assertIsNone(json.loads(run("query", self.map, "--why", thing["id"], "--json").stdout)["prior"])
        why, lines = self.told(thing["id"], sorted([[best, -2.0], [other, 2.0]]))
        names = [one["name"] for one in why["classes"][:2]]
        self.assertEqual(names[0], thing["name"])
        self.assertEqual([one["name"] for one in why["prior"]["classes"]], names)
        for one, power in zip(why["prior"]["classes"], (-2, 2), strict=True):
            self.assertAlmostEqual(one["factor"], math.exp(power), places=9)
        self.assertFalse(why["prior"]["of_each_observation"])
        self.assertEqual(lines, [f"  prior      outside knowledge makes {names[1]} {math.exp(4):.2f} times as "
                                 f"probable against {names[0]} as detections alone"])
        why, lines = self.told(thing["id"], sorted([[best, 0.0], [other, 3.0]]))
        self.assertIn(f"makes {names[1]} {math.exp(3):.2f} times", lines[0])
        why, lines = self.told(thing["id"], sorted([[best, 3.0], [other, 3.0]]))
        self.assertEqual(lines, [])

    def test_outside_knowledge_that_is_rounding_is_none(self):
        thing = self.objects()[0]
        best, _ = self.most_and_least_believed(thing["id"])
        why, lines = self.told(thing["id"], [[best, -1e-16]])
        self.assertIsNone(why["prior"])
        self.assertEqual(lines, [])

    def test_a_runner_up_of_what_is_left_is_not_named(self):
        """A detector that names one class alone leaves the others alike; the second is the lowest id of them."""
        thing = self.objects()[0]
        self.assertLess(thing["runner_up"]["probability"], 0.005)
        table = run("query", self.map, "--layer", "objects").stdout.splitlines()
        self.assertRegex(table[1], rf" -  {thing['name']} 0\.\d\d$")
        best, _ = self.most_and_least_believed(thing["id"])
        why, lines = self.told(thing["id"], [[best, 1.0]])
        self.assertAlmostEqual(why["prior"]["classes"][0]["factor"], math.e, places=9)
        self.assertEqual(lines, [])


if __name__ == "__main__":
    unittest.main()
