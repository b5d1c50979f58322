# Sourced by the scripts of points that plan: what the row says that `pm-plan --format csv` prints.
# shellcheck shell=bash

# The pipe that makes the picture is the first field. It is quoted where it holds a comma or a quote; quotes in it are doubled then.
#   planned_pipe ROW
planned_pipe() {
    awk 'NR == 2' "$1" | sed -E 's/^"(([^"]|"")*)",.*/\1/; t quoted; s/,.*//; b; :quoted s/""/"/g'
}

# Numbers stand between the pipe and `next_best`, so they are counted from behind the pipe; a comma stands between them here too.
#   planned ROW NAME,NAME...
planned() {
    awk -v names="$2" -F, '
        NR == 1 { for (i = 2; i <= NF; i++) at[$i] = i - 1 }
        NR == 2 {
            sub(/^"([^"]|"")*",/, "") || sub(/^[^,]*,/, "")
            n = split($0, fields, ","); m = split(names, name, ",")
            for (i = 1; i <= m; i++) printf "%s%s", (i > 1 ? "," : ""), fields[at[name[i]]]
        }' "$1"
}

# What searches fetch stands at the end: the bytes, their interval, and how to measure them in full.
#   planned_traffic ROW: four lines
planned_traffic() {
    awk 'NR == 2' "$1" | sed -E 's/^.*,([^,"]*),([^,"]*),([^,"]*),(("([^"]|"")*")|[^,"]*)$/\1\n\2\n\3\n\4/' |
        sed -E '4 { s/^"(.*)"$/\1/; s/""/"/g }'
}
