# What share of the emitted flux arrives at each surface of the diffuse Cornell box, from its photons as text:
#   pm-view --records box.pmp | awk -v paths=EMITTED -f scripts/flux.awk
# Surfaces are told by their place: scenes/cornell-diffuse.obj has its walls at the sides of the unit cube, and the two
# blocks stand upright about the axes below.

BEGIN {
    FS = "\t"
    pi = atan2(0, -1)
    # Area times radiance times pi.
    area = 0.25 * 0.1875
    emitted["r"] = pi * area * 18; emitted["g"] = pi * area * 14; emitted["b"] = pi * area * 7
    tall_x = -0.16; tall_z = -0.16; short_x = 0.18; short_z = 0.17
    count = split("floor ceiling left right back tall short", names, " ")
}

NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

{
    x = $at["x"]; y = $at["y"]; z = $at["z"]
    if (y == 0) surface = "floor"
    else if (y == 1) surface = "ceiling"
    else if (x == -0.5) surface = "left"
    else if (x == 0.5) surface = "right"
    else if (z == -0.5) surface = "back"
    else if ((x - tall_x) ^ 2 + (z - tall_z) ^ 2 < (x - short_x) ^ 2 + (z - short_z) ^ 2) surface = "tall"
    else surface = "short"
    r[surface] += $at["power_r"]; g[surface] += $at["power_g"]; b[surface] += $at["power_b"]
}

END {
    if (NR < 2) exit 1
    print "name,r,g,b"
    for (i = 1; i <= count; i++) {
        s = names[i]
        all["r"] += r[s]; all["g"] += g[s]; all["b"] += b[s]
        row(s, r[s], g[s], b[s])
    }
    row("all", all["r"], all["g"], all["b"])
}

function row(name, r, g, b) {
    printf "%s,%.9g,%.9g,%.9g\n", name, r / paths / emitted["r"], g / paths / emitted["g"], b / paths / emitted["b"]
}
