# Moves a scene: every position p becomes scale p + offset, in an OBJ or in its camera file.
#   awk -v scale=1000 -v offset=1e5 -f scripts/place.awk scenes/furnace.obj > out/furnace.obj

function placed(x) { return sprintf("%.10g", x * scale + offset) }

/^v / { print "v", placed($2), placed($3), placed($4); next }

/^(eye|look_at) *=/ {
    match($0, /\[[^]]*\]/)
    split(substr($0, RSTART + 1, RLENGTH - 2), p, ",")
    printf "%s= [%s, %s, %s]\n", substr($0, 1, index($0, "=") - 1), placed(p[1]), placed(p[2]), placed(p[3])
    next
}

{ print }
