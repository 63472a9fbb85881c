# SPDX-License-Identifier: BSD-3-Clause
"""Archives of many small things, each within its own limit, that ask for far too much together."""

import math
import struct
import zipfile
import zlib

OCCUPANCY = ("image: {image}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
             "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: scale\n")


def write_archive(path, members):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in members:
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    return path


def blank_png(side_px):
    """One bit a pixel."""

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    rows = (b"\0" * (1 + (side_px + 7) // 8)) * side_px
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side_px, side_px, 1, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def layers_of(kind, names):
    return "layers:\n" + "".join(
        f"  - {{class: {kind}, name: {name}, frame_id: map, load_file: true}}\n" for name in names)


def many_images(path, count=250, side_px=16384):
    """Layers that each decode to 2^28 pixels: 67 GB of cells in all."""
    image = blank_png(side_px)
    names = [f"grid{i:03}" for i in range(count)]
    members = [("hmap_config.yaml", layers_of("OccupancyGridLayer", names))]
    for name in names:
        members += [(f"{name}.yaml", OCCUPANCY.format(image=f"{name}.png")), (f"{name}.png", image)]
    return write_archive(path, members)


def star(num_points, step):
    """A star polygon that crosses itself num_points * (step - 1) times."""
    angles = [2 * math.pi * (i * step % num_points) / num_points for i in range(num_points + 1)]
    return "POLYGON((" + ",".join(f"{10 * math.cos(a):.3f} {10 * math.sin(a):.3f}" for a in angles) + "))"


def many_stars(path, count=1400, num_points=449, step=223):
    """Shapes just below the limit of 100,000 crossings: minutes in all."""
    shape = star(num_points, step)
    shapes = "".join(f'- {{name: star{i:04}, shape: "{shape}"}}\n' for i in range(count))
    return write_archive(path, [("hmap_config.yaml", layers_of("SemanticLayer", ["semantic"])),
                                ("semantic", shapes)])


def many_opaque_members(path, count=1000, num_bytes=1 << 20):
    """Members that nothing names and that are therefore kept.

    One content for all: what a child is measured to take at most begins with what its parent once took.
    """
    content = bytes(num_bytes)
    members = [(f"part{i:04}", content) for i in range(count)]
    return write_archive(path, [("hmap_config.yaml", "layers: []\n"), *members])


def full_octree(depth):
    """A `.bt` whose nodes above `depth` all have eight children; (bytes, number of nodes)."""

    def nodes(level):
        return b"\x55\x55" if level + 1 == depth else b"\xff\xff" + 8 * nodes(level + 1)

    num_nodes = (8 ** (depth + 1) - 1) // 7
    header = f"# Octomap OcTree binary file\nid OcTree\nsize {num_nodes}\nres 0.05\ndata\n"
    return header.encode() + nodes(0), num_nodes


def many_octrees(path, count=100, depth=7):
    """Octrees of 2.4 million nodes each: 32 bytes in memory for each byte of a member."""
    tree, _ = full_octree(depth)
    extensions = "".join(
        f"  - {{format: octomap, version: 1, name: tree{i:03}, frame_id: map, file: tree{i:03}.bt}}\n"
        for i in range(count))
    config = "format_version: 1\nlayers: []\nextensions:\n" + extensions
    return write_archive(path, [("hmap_config.yaml", config),
                                *((f"tree{i:03}.bt", tree) for i in range(count))])
