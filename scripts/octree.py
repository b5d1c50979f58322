"""What would an octree over photons in Morton order read, beside the leaves of a kd-tree of medians?

    pm-view --records out/map.pmp | python3 scripts/octree.py

For balls that hold the 100 nearest of 200 photons: the leaves of six photons each, or of at most six, that a ball meets. The
octree's photons may also lie packed, 20 bytes each in lines of 128, and then it is the lines of those leaves.
"""
import heapq
import sys
from bisect import bisect_left

LEAF, K, SEARCHES, BITS, LINE, RECORD = 6, 100, 200, 16, 128, 20

rows = (line.split("\t") for line in sys.stdin)
first = next(rows).index("x")
photons = [tuple(map(float, row[first:first + 3])) for row in rows]
axes = range(3)
low = [min(p[a] for p in photons) for a in axes]
size = max(max(p[a] for p in photons) - low[a] for a in axes) * 1.000001


def bounds(points):
    return [min(p[a] for p in points) for a in axes], [max(p[a] for p in points) for a in axes]


def morton(p):
    cell = [int((p[a] - low[a]) / size * (1 << BITS)) for a in axes]
    return sum((cell[a] >> bit & 1) << (3 * bit + a) for bit in range(BITS) for a in axes)


def median_leaves(points):
    if len(points) <= LEAF:
        return [bounds(points)]
    least, most = bounds(points)
    axis = max(axes, key=lambda a: most[a] - least[a])
    points.sort(key=lambda p: p[axis])
    middle = -(-len(points) // LEAF) // 2 * LEAF
    return median_leaves(points[:middle]) + median_leaves(points[middle:])


keys = sorted(map(morton, photons))


def octree_leaves(start, end, level, corner):
    """(bounds, first photon, last photon) of the cells below one that holds photons `start..end` of the Morton order."""
    side = size / (1 << level)
    if end - start <= LEAF or level == BITS:
        return [((corner, [x + side for x in corner]), start, end - 1)] if end > start else []
    shift, leaves = 3 * (BITS - level - 1), []
    base = keys[start] >> (shift + 3) << 3
    for octant in range(8):
        part = [bisect_left(keys, (base | octant) + i << shift, start, end) for i in (0, 1)]
        leaves += octree_leaves(*part, level + 1, [corner[a] + side / 2 * (octant >> a & 1) for a in axes])
    return leaves


def outside(p, box):
    return sum(max(box[0][a] - p[a], p[a] - box[1][a], 0) ** 2 for a in axes)


cells, leaves = octree_leaves(0, len(keys), 0, low), median_leaves(photons[:])
met = {"kd leaves": 0, "octree leaves": 0, "octree lines, packed": 0}
centres = photons[::max(len(photons) // SEARCHES, 1)][:SEARCHES]
for p in centres:
    radius = heapq.nsmallest(K, (sum((q[a] - p[a]) ** 2 for a in axes) for q in photons))[-1]
    met["kd leaves"] += sum(outside(p, box) <= radius for box in leaves)
    hit = [cell for cell in cells if outside(p, cell[0]) <= radius]
    met["octree leaves"] += len(hit)
    lines = (range(a * RECORD // LINE, (b * RECORD + RECORD - 1) // LINE + 1) for _, a, b in hit)
    met["octree lines, packed"] += len(set().union(*lines))
print(f"{len(leaves)} kd leaves, {len(cells)} octree leaves of {len(photons) / len(cells):.2f} photons; a ball meets")
for name, number in met.items():
    print(f"{number / len(centres):6.1f} {name}")
