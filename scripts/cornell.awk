#!/usr/bin/awk -f
# Writes scenes/cornell.obj: a Cornell box with a mirror and a glass sphere.
#
#   awk -f scripts/cornell.awk > scenes/cornell.obj
#
# A sphere is an icosahedron whose triangles are cut in four `levels` times (20 * 4^levels triangles) and whose
# vertices are moved out to the sphere. Each vertex's place on the unit sphere is its `vn`; both spheres share them.
# Numbers are rounded to six decimals, which the loader's normalisation of `vn` makes good.

function vertex(x, y, z,    length_) {
    length_ = sqrt(x * x + y * y + z * z)
    n++
    X[n] = x / length_; Y[n] = y / length_; Z[n] = z / length_
    return n
}

# The vertex halfway between two, made when first asked for.
function middle(a, b,    key) {
    key = a < b ? a " " b : b " " a
    if (!(key in mid)) mid[key] = vertex(X[a] + X[b], Y[a] + Y[b], Z[a] + Z[b])
    return mid[key]
}

function icosphere(levels,    g, i, level, old, A, B, C, a, b, c, ab, bc, ca) {
    g = (1 + sqrt(5)) / 2
    vertex(-1, g, 0); vertex(1, g, 0); vertex(-1, -g, 0); vertex(1, -g, 0)
    vertex(0, -1, g); vertex(0, 1, g); vertex(0, -1, -g); vertex(0, 1, -g)
    vertex(g, 0, -1); vertex(g, 0, 1); vertex(-g, 0, -1); vertex(-g, 0, 1)
    faces = split("1 12 6,1 6 2,1 2 8,1 8 11,1 11 12,2 6 10,6 12 5,12 11 3,11 8 7,8 2 9," \
                  "4 10 5,4 5 3,4 3 7,4 7 9,4 9 10,5 10 6,3 5 12,7 3 11,9 7 8,10 9 2", F, ",")
    for (level = 0; level < levels; level++) {
        old = faces
        for (i = 1; i <= old; i++) { split(F[i], t, " "); A[i] = t[1]; B[i] = t[2]; C[i] = t[3] }
        faces = 0
        for (i = 1; i <= old; i++) {
            a = A[i]; b = B[i]; c = C[i]
            ab = middle(a, b); bc = middle(b, c); ca = middle(c, a)
            F[++faces] = a " " ab " " ca
            F[++faces] = b " " bc " " ab
            F[++faces] = c " " ca " " bc
            F[++faces] = ab " " bc " " ca
        }
    }
}

# A number with at most six decimals and nothing that can be left out.
function short(x,    s) {
    s = sprintf("%.6f", x)
    sub(/0+$/, "", s); sub(/\.$/, "", s); sub(/^-0$/, "0", s)
    sub(/^0\./, ".", s); sub(/^-0\./, "-.", s)
    return s
}

function sphere(name, material, x, y, z, r,    i, t, first) {
    print "o " name
    for (i = 1; i <= n; i++) print "v " short(x + r * X[i]) " " short(y + r * Y[i]) " " short(z + r * Z[i])
    print "usemtl " material
    first = points
    points += n
    for (i = 1; i <= faces; i++) {
        split(F[i], t, " ")
        print "f " first + t[1] "//" t[1] " " first + t[2] "//" t[2] " " first + t[3] "//" t[3]
    }
}

BEGIN {
    icosphere(3)
    print "# Cornell box with a mirror and a glass sphere. Own work of this project."
    print "# Written by scripts/cornell.awk; do not edit. Metres, y up, open towards the camera at +z."
    print "mtllib cornell.mtl"
    print "# floor and ceiling corners, then the light in a hole of the ceiling"
    print "v -.5 0 .5\nv .5 0 .5\nv .5 0 -.5\nv -.5 0 -.5"
    print "v -.5 1 .5\nv .5 1 .5\nv .5 1 -.5\nv -.5 1 -.5"
    print "v -.125 1 .09375\nv .125 1 .09375\nv .125 1 -.09375\nv -.125 1 -.09375"
    points = 12
    print "o box\nusemtl white"
    print "f 1 2 3 4\nf 4 3 7 8"
    print "f 5 9 10 6\nf 6 10 11 7\nf 7 11 12 8\nf 8 12 9 5"
    print "usemtl red\nf 1 4 8 5"
    print "usemtl green\nf 3 2 6 7"
    print "o light\nusemtl light\nf 9 12 11 10"
    print "# normals of both spheres"
    for (i = 1; i <= n; i++) print "vn " short(X[i]) " " short(Y[i]) " " short(Z[i])
    sphere("mirror-sphere", "mirror", -.21, .176, -.2, .175)
    sphere("glass-sphere", "glass", .21, .176, .16, .175)
}
