# What was found beside what is known, and whether it is near enough; exit 1 if a row is not, or is not there:
#   awk -f scripts/accuracy.awk scripts/accuracy.csv out/accuracy/box.csv out/accuracy/flux.csv ...
# The first file says what is known (its head explains it). The others, named after their experiments, are what
# `pm-view --mean --format csv` prints, or rows of name,r,g,b and maybe the standard errors se_r,se_g,se_b.
# The difference printed is that of the worst channel.

BEGIN { FS = ","; split("r g b", channels, " ") }

FNR == 1 { head = 1 }

/^#/ { next }

head {
    head = 0
    file++
    split("", at)
    for (i = 1; i <= NF; i++) at[$i] = i
    experiment = FILENAME
    sub(/.*\//, "", experiment); sub(/\.csv$/, "", experiment)
    next
}

file == 1 { rows++; for (name in at) known[rows, name] = $at[name]; next }

{
    part = ("name" in at) ? $at["name"] : $at["x0"] " " $at["y0"] " " $at["x1"] " " $at["y1"]
    found[experiment, part, "pixels"] = ("pixels" in at) ? $at["pixels"] : 1
    for (c = 1; c <= 3; c++) {
        channel = channels[c]
        # What is no number was not measured: nan is neither near nor far.
        if ($at[channel] ~ /^[-+]?[0-9.]+(e[-+]?[0-9]+)?$/) found[experiment, part, channel] = $at[channel]
        found[experiment, part, "se_" channel] = (("se_" channel) in at) ? $at["se_" channel] : 0
    }
}

# The value of a part of an experiment, or "" if it was not measured.
function value(experiment, part, channel,    two, whole, hole) {
    if (split(part, two, " - ") == 2) {
        whole = value(experiment, two[1], channel); hole = value(experiment, two[2], channel)
        if (whole == "" || hole == "") return ""
        whole *= found[experiment, two[1], "pixels"]; hole *= found[experiment, two[2], "pixels"]
        return (whole - hole) / (found[experiment, two[1], "pixels"] - found[experiment, two[2], "pixels"])
    }
    return ((experiment, part, channel) in found) ? found[experiment, part, channel] : ""
}

function size(x) { return x < 0 ? -x : x }

function shown(x) { return x == "" ? "-" : x >= 1000 ? sprintf("%.0f", x) : sprintf("%.5g", x) }

END {
    line = "%-46s %-27s %-27s %11s  %-10s %s\n"
    printf line, "scene and experiment", "known (r g b)", "found (r g b)", "difference", "tolerance", ""
    for (row = 1; row <= rows; row++) {
        experiment = known[row, "experiment"]; part = known[row, "part"]
        count = split(known[row, "tolerance"], words, " ")
        words_known = words_found = ""; worst = 0; se_at_worst = 0; missing = 0
        for (c = 1; c <= 3; c++) {
            channel = channels[c]
            expected = known[row, channel]
            if (known[row, "r"] ~ /^=/) expected = value(substr(known[row, "r"], 2), part, channel)
            got = value(experiment, part, channel)
            # A number of things has one channel only.
            if (c > 1 && part == "searches") break
            words_known = words_known (c > 1 ? " " : "") shown(expected)
            words_found = words_found (c > 1 ? " " : "") shown(got)
            if (expected == "" || got == "" || expected + 0 == 0) { missing = 1; continue }
            if (words[count] == "SE") {
                se = sqrt(found[experiment, part, "se_" channel] ^ 2 + known[row, "se_" channel] ^ 2)
                if (se == 0) { missing = 1; continue }
                off = (got - expected) / se
            } else if (words[1] == "at") off = got / expected
            else off = 100 * (got / expected - 1)
            if (size(off) >= size(worst)) { worst = off; se_at_worst = se }
        }
        if (words[1] == "at") { most = words[3]; difference = sprintf("x %.4f", worst) }
        else if (words[2] == "SE") { most = words[1]; difference = sprintf("%+.2f SE", worst) }
        else { most = words[1]; difference = sprintf("%+.3f %%", worst) }
        good = !missing && size(worst) <= most
        if (missing) difference = "missing"
        bad += !good
        printf line, known[row, "what"], words_known, words_found, difference, known[row, "tolerance"], good ? "ok" : "NOT OK"
        if (words[2] == "SE" && !missing)
            if (se_at_worst > largest_se) largest_se = se_at_worst
    }
    if (largest_se) printf "\nStandard errors (SE) of the fluxes are at most %.2g of what is emitted.\n", largest_se
    if (!rows || bad) { printf "%d of %d rows are NOT OK\n", bad, rows; exit 1 }
    printf "all %d rows are ok\n", rows
}
