# SPDX-License-Identifier: BSD-3-Clause
"""A dataset of a few small frames, each part of which can be replaced by a bad one."""

import json
import struct
import zlib


def _chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def depth_png(width, height, value):
    """A 16-bit grey PNG that measures the same everywhere."""
    rows = (b"\0" + struct.pack(">H", value) * width) * height
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)) +
            _chunk(b"IDAT", zlib.compress(rows)) + _chunk(b"IEND", b""))


def color_png(width, height, value):
    """An RGB PNG of one grey."""
    rows = (b"\0" + bytes([value, value, value]) * width) * height
    return (b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            _chunk(b"IDAT", zlib.compress(rows)) + _chunk(b"IEND", b""))


def make_dataset(folder, stamps=("1.0", "1.1"), size=(32, 24)):
    """TUM layout, no colour: a wall 1 m before a camera that stands still 1 m above the ground."""
    width, height = size
    (folder / "depth").mkdir(parents=True)
    for i, _ in enumerate(stamps):
        (folder / f"depth/{i}.png").write_bytes(depth_png(width, height, 5000))
    (folder / "depth.txt").write_text("".join(f"{stamp} depth/{i}.png\n" for i, stamp in enumerate(stamps)))
    (folder / "groundtruth.txt").write_text("".join(f"{stamp} 0 0 1 0 0 0 1\n" for stamp in stamps))
    (folder / "camera.json").write_text(json.dumps(
        {"width": width, "height": height, "fx": width * 0.9, "fy": width * 0.9, "cx": width / 2 - 0.5,
         "cy": height / 2 - 0.5, "depth_scale": 5000}))
    return folder
