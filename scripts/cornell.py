"""Writes scenes/cornell.obj: a Cornell box with a mirror and a glass sphere.

    python3 scripts/cornell.py > scenes/cornell.obj

A sphere is an icosahedron whose triangles are cut in four three times (20 * 4^3 triangles) and whose vertices are moved out to
the sphere. Each vertex's place on the unit sphere is its `vn`; both spheres share them. Numbers are rounded to six decimals,
which the loader's normalisation of `vn` makes good.
"""
from math import sqrt

LEVELS = 3
vertices, middles = [], {}


def vertex(x, y, z):
    length = sqrt(x * x + y * y + z * z)
    vertices.append((x / length, y / length, z / length))
    return len(vertices)


def middle(a, b):
    """The vertex halfway between two, made when first asked for."""
    key = (min(a, b), max(a, b))
    if key not in middles:
        middles[key] = vertex(*(p + q for p, q in zip(vertices[a - 1], vertices[b - 1])))
    return middles[key]


def icosphere():
    g = (1 + sqrt(5)) / 2
    for corner in [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
                   (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]:
        vertex(*corner)
    faces = [tuple(map(int, face.split())) for face in
             "1 12 6,1 6 2,1 2 8,1 8 11,1 11 12,2 6 10,6 12 5,12 11 3,11 8 7,8 2 9,"
             "4 10 5,4 5 3,4 3 7,4 7 9,4 9 10,5 10 6,3 5 12,7 3 11,9 7 8,10 9 2".split(",")]
    for _ in range(LEVELS):
        old, faces = faces, []
        for a, b, c in old:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            faces += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    return faces


def short(x):
    """A number with at most six decimals and nothing that can be left out."""
    text = f"{x:.6f}".rstrip("0").rstrip(".")
    text = "0" if text == "-0" else text
    return text.replace("-0.", "-.", 1) if text.startswith("-0.") else text[1:] if text.startswith("0.") else text


def point(keyword, p):
    print(keyword, *map(short, p))


def sphere(name, material, centre, radius, first):
    print("o", name)
    for p in vertices:
        point("v", (c + radius * x for c, x in zip(centre, p)))
    print("usemtl", material)
    for face in faces:
        print("f", *(f"{first + corner}//{corner}" for corner in face))


faces = icosphere()
print("""# Cornell box with a mirror and a glass sphere. Own work of this project.
# Written by scripts/cornell.py; do not edit. Metres, y up, open towards the camera at +z.
mtllib cornell.mtl
# floor and ceiling corners, then the light in a hole of the ceiling
v -.5 0 .5
v .5 0 .5
v .5 0 -.5
v -.5 0 -.5
v -.5 1 .5
v .5 1 .5
v .5 1 -.5
v -.5 1 -.5
v -.125 1 .09375
v .125 1 .09375
v .125 1 -.09375
v -.125 1 -.09375
o box
usemtl white
f 1 2 3 4
f 4 3 7 8
f 5 9 10 6
f 6 10 11 7
f 7 11 12 8
f 8 12 9 5
usemtl red
f 1 4 8 5
usemtl green
f 3 2 6 7
o light
usemtl light
f 9 12 11 10
# normals of both spheres""")
for p in vertices:
    point("vn", p)
sphere("mirror-sphere", "mirror", (-.21, .176, -.2), .175, 12)
sphere("glass-sphere", "glass", (.21, .176, .16), .175, 12 + len(vertices))
