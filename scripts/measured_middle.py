# SPDX-License-Identifier: BSD-3-Clause
"""Where the middle of what was measured of a thing lies: of the convex hull of the cells that `hypermap simulate` saw it in."""


def convex_hull(points):
    """Counterclockwise, without points on its sides (Andrew's monotone chain)."""
    points = sorted(set(points))

    def chain(ordered):
        kept = []
        for point in ordered:
            while len(kept) > 1 and turn(kept[-2], kept[-1], point) <= 0:
                kept.pop()
            kept.append(point)
        return kept[:-1]

    return points if len(points) < 3 else chain(points) + chain(points[::-1])


def turn(a, b, c):
    """Twice the area of the triangle, positive when it runs counterclockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def middle(points):
    """The centroid of the hull's area; of points on one line their mean. Requires: a point."""
    hull = convex_hull(points)
    triangles = [(turn(hull[0], b, c), b, c) for b, c in zip(hull[1:], hull[2:])]
    area = sum(weight for weight, _, _ in triangles)
    if area == 0:
        return tuple(sum(axis) / len(hull) for axis in zip(*hull))
    return tuple(sum(weight * (hull[0][i] + b[i] + c[i]) / 3 for weight, b, c in triangles) / area for i in (0, 1))


def columns(seen_cells, edge_m):
    """Middles of the columns of the cells, metres; `seen_cells` as true_surfaces.jsonl has them: x, y, z, x, y, z and so on."""
    return {((x + 0.5) * edge_m, (y + 0.5) * edge_m) for x, y in zip(seen_cells[::3], seen_cells[1::3])}
