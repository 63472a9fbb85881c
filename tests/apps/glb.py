# SPDX-License-Identifier: BSD-3-Clause
"""A strict reader of glTF 2.0's binary form, for what this project writes of it: positions and triangles, materials of
one colour, a tree of nodes. Whatever breaks a rule of the specification is an AssertionError that names the rule."""

import dataclasses
import json
import math
import struct

FLOAT, USHORT, UINT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
COMPONENT_BYTES = {FLOAT: 4, USHORT: 2, UINT: 4}
KEYS = {"asset": {"version", "generator"}, "scenes": {"nodes"},
        "nodes": {"name", "translation", "rotation", "mesh", "children", "extras"}, "meshes": {"name", "primitives"},
        "materials": {"name", "pbrMetallicRoughness", "alphaMode"},
        "accessors": {"bufferView", "byteOffset", "componentType", "count", "type", "min", "max"},
        "bufferViews": {"buffer", "byteOffset", "byteLength", "byteStride", "target"}, "buffers": {"byteLength"}}


def check(holds, rule):
    if not holds:
        raise AssertionError(rule)


def chunks_of(data):
    """JSON and binary chunk; section 4.4 of the specification."""
    check(len(data) % 4 == 0, "the file is a multiple of 4 bytes")
    check(struct.unpack_from("<4sII", data) == (b"glTF", 2, len(data)), "magic, version and length are the file's")
    found, at = [], 12
    while at < len(data):
        check(at + 8 <= len(data), "a chunk has a head")
        size, kind = struct.unpack_from("<I4s", data, at)
        check(size % 4 == 0 and at + 8 + size <= len(data), "a chunk is aligned and within the file")
        found.append((kind, data[at + 8:at + 8 + size]))
        at += 8 + size
    check([kind for kind, _ in found] == [b"JSON", b"BIN\0"], "one JSON chunk, then one binary chunk")
    return found[0][1], found[1][1]


def rotated(quaternion, point):
    """The point turned by the unit quaternion x, y, z, w."""
    x, y, z, w = quaternion
    cross = [y * point[2] - z * point[1] + w * point[0], z * point[0] - x * point[2] + w * point[1],
             x * point[1] - y * point[0] + w * point[2]]
    return [point[0] + 2 * (y * cross[2] - z * cross[1]), point[1] + 2 * (z * cross[0] - x * cross[2]),
            point[2] + 2 * (x * cross[1] - y * cross[0])]


@dataclasses.dataclass
class Part:
    """Triangles of one material: positions in the scene (+y up), indices and the material."""

    positions: list
    indices: list
    material: dict


class Scene:
    """A file that broke no rule. `nodes` by name: each its JSON; `parts(name)` its triangles in the scene."""

    def __init__(self, data):
        text, self.binary = chunks_of(data)
        self.json = json.loads(text.decode("utf-8"), parse_constant=lambda name: check(False, f"{name} is no number"))
        check(set(self.json) == {*KEYS, "scene"}, "the members are those that are written")
        for member, keys in KEYS.items():
            for item in self.json[member] if isinstance(self.json[member], list) else [self.json[member]]:
                check(set(item) <= keys, f"{member} have known keys alone")
            check(self.json[member], f"{member} are not empty")
        check(self.json["asset"]["version"] == "2.0" and self.json["scene"] == 0, "version 2.0, the first scene")
        check(len(self.json["buffers"]) == 1 and "uri" not in self.json["buffers"][0], "one buffer, that of the file")
        padding = len(self.binary) - self.json["buffers"][0]["byteLength"]
        check(0 <= padding < 4, "the binary chunk is the buffer, padded")
        self.check_views()
        self.values = [self.values_of(accessor) for accessor in self.json["accessors"]]
        self.check_meshes()
        self.parents = self.check_tree()
        self.nodes = {node["name"]: node for node in self.json["nodes"]}
        check(len(self.nodes) == len(self.json["nodes"]), "no two nodes have one name")

    def check_views(self):
        for view in self.json["bufferViews"]:
            end = view.get("byteOffset", 0) + view["byteLength"]
            check(view["buffer"] == 0 and view["byteLength"] > 0 and end <= len(self.binary), "a view is in the buffer")
            check(view["target"] in (ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER), "a view says what it is for")
            check(("byteStride" in view) == (view["target"] == ARRAY_BUFFER), "vertices have a stride, indices none")

    def values_of(self, accessor):
        view = self.json["bufferViews"][accessor["bufferView"]]
        size = COMPONENT_BYTES[accessor["componentType"]]
        is_position = accessor["type"] == "VEC3"
        check(is_position == (accessor["componentType"] == FLOAT), "positions are floats, indices are not")
        check(view["target"] == (ARRAY_BUFFER if is_position else ELEMENT_ARRAY_BUFFER), "data lie in a view for them")
        start = view.get("byteOffset", 0) + accessor["byteOffset"]
        check(start % size == 0 and accessor["byteOffset"] % size == 0, "data are aligned to their components")
        count, width = accessor["count"], 3 if is_position else 1
        stride = view.get("byteStride", size * width)
        check(count > 0 and stride == size * width, "data are there and dense")
        check(accessor["byteOffset"] + count * stride <= view["byteLength"], "data end within their view")
        letter = {FLOAT: "f", USHORT: "H", UINT: "I"}[accessor["componentType"]]
        numbers = struct.unpack_from(f"<{count * width}{letter}", self.binary, start)
        if not is_position:
            check("min" not in accessor, "indices have no bounds here")
            return list(numbers)
        check(all(map(math.isfinite, numbers)), "positions are finite")
        points = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
        check(accessor["min"] == [min(axis) for axis in zip(*points)], "min is the least of the positions")
        check(accessor["max"] == [max(axis) for axis in zip(*points)], "max is the largest of the positions")
        return points

    def check_meshes(self):
        used = set()
        for mesh in self.json["meshes"]:
            check(mesh["primitives"], "a mesh has a primitive")
            for primitive in mesh["primitives"]:
                check(set(primitive) == {"attributes", "indices", "material"}, "a primitive is triangles of a material")
                positions = self.values[primitive["attributes"]["POSITION"]]
                indices = self.values[primitive["indices"]]
                is_long = self.json["accessors"][primitive["indices"]]["componentType"] == UINT
                check(len(indices) % 3 == 0, "three indices a triangle")
                check(max(indices) < len(positions) and (is_long or max(indices) < 65535), "indices are of positions")
                used.add(primitive["material"])
        check(used == set(range(len(self.json["materials"]))), "all materials are used, no other")
        for material in self.json["materials"]:
            factor = material["pbrMetallicRoughness"]["baseColorFactor"]
            check(len(factor) == 4 and all(0 <= part <= 1 for part in factor), "colours are in [0, 1]")
            check(material.get("alphaMode", "OPAQUE") == ("BLEND" if factor[3] < 1 else "OPAQUE"), "opacity is blended")

    def check_tree(self):
        parents = {}
        for number, node in enumerate(self.json["nodes"]):
            check(node["name"] and node.get("mesh", 0) < len(self.json["meshes"]), "a node has a name and a known mesh")
            check(abs(math.hypot(*node.get("rotation", [1])) - 1) < 1e-9, "a turn is a unit quaternion")
            for child in node.get("children", []):
                check(child not in parents, "a node has one parent")
                parents[child] = number
        roots = [number for number in range(len(self.json["nodes"])) if number not in parents]
        check(self.json["scenes"] == [{"nodes": roots}] and len(roots) == 1, "the scene has one root and all nodes")
        return parents

    def in_scene(self, number, point):
        """A point of a node's own frame in the scene's."""
        while number is not None:
            node = self.json["nodes"][number]
            point = rotated(node.get("rotation", [0, 0, 0, 1]), point)
            point = [a + b for a, b in zip(point, node.get("translation", [0, 0, 0]))]
            number = self.parents.get(number)
        return point

    def parts(self, name):
        number = self.json["nodes"].index(self.nodes[name])
        return [Part([self.in_scene(number, point) for point in self.values[primitive["attributes"]["POSITION"]]],
                     self.values[primitive["indices"]], self.json["materials"][primitive["material"]])
                for primitive in self.json["meshes"][self.nodes[name]["mesh"]]["primitives"]]

    def map_bounds(self, name):
        """Bounds of a node's mesh in the map's own axes (+z up): low x, y, z, high x, y, z."""
        points = [(x, -z, y) for part in self.parts(name) for x, y, z in part.positions]
        return [*(min(axis) for axis in zip(*points)), *(max(axis) for axis in zip(*points))]
