"""Photons and queries as arrays, by `formats/README.md`."""

import numpy as np

PHOTON = np.dtype([("position", "<f4", 3), ("rgbe", "u1", 4), ("from", "<u2"), ("packed", "<u2")])
PHOTON_OF_A_PART = np.dtype(
    [("position", "<f4", 3), ("power", "<f4", 3), ("from", "<u2"), ("packed", "<u2"), ("path", "<u4")]
)
QUERY = np.dtype(
    [
        ("position", "<f4", 3),
        ("normal", "<u2", 2),
        ("view", "<u2", 2),
        ("material", "<u2"),
        ("flags", "<u2"),
        ("pixel", "<u4"),
        ("sample", "<u4"),
        ("weight", "<f4", 3),
    ]
)


def unpacked(payload, rows, width):
    """The rows of a payload that is packed by words, as bytes: first the first words of all rows, then the second."""
    words = np.frombuffer(payload, "<u4").reshape(width, rows)
    return np.ascontiguousarray(words.T).view("u1").reshape(rows, 4 * width)


def power(photons):
    """Flux of each photon times the number of emitted paths, red, green, blue."""
    rgbe = photons["rgbe"].astype(np.float64)
    scale = np.where(rgbe[:, 3] > 0, np.exp2(rgbe[:, 3] - 136), 0.0)
    return rgbe[:, :3] * scale[:, None]


def octahedral(x, y):
    """Unit vectors of points of the octahedron, coordinates from -1 to 1."""
    z = 1.0 - np.abs(x) - np.abs(y)
    sign = lambda a: np.where(a < 0, -1.0, 1.0)
    folded = z < 0
    x, y = np.where(folded, (1 - np.abs(y)) * sign(x), x), np.where(folded, (1 - np.abs(x)) * sign(y), y)
    vector = np.stack([x, y, z], axis=-1)
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def _coordinate(stored, bits):
    half = (1 << bits - 1) - 1
    return stored / half - 1.0


def came_from(photons):
    """Unit vectors towards where each photon came from."""
    packed = photons["from"].astype(np.int64)
    return octahedral(_coordinate(packed & 255, 8), _coordinate(packed >> 8, 8))


def surface_normal(photons):
    """Unit normals of the surfaces that photons lie on."""
    packed = photons["packed"].astype(np.int64) >> 2
    return octahedral(_coordinate(packed & 127, 7), _coordinate(packed >> 7, 7))


def shading_normal(queries):
    """Unit normals of the surfaces that queries lie on, on the viewer's side."""
    stored = queries["normal"].astype(np.float64)
    return octahedral(_coordinate(stored[:, 0], 16), _coordinate(stored[:, 1], 16))
