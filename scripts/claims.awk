# The paper's sentences beside our results, and what comes of them:
#   awk -f scripts/csv.awk -f scripts/claims.awk scripts/claims.csv                the verdicts, as CSV; fails if a result is missing
#   awk -v list=1 -f scripts/csv.awk -f scripts/claims.awk scripts/claims.csv      the files of results that they need
# scripts/claims.csv says how a line is written. Where a limit lies within the 95 % interval of what was sampled, nothing is decided.

function fail(why) { print FILENAME ":" FNR ": " why > "/dev/stderr"; failed = 1; exit 1 }

# A column of a point's row.
function result(reference,   at, file, column, which, line, n, i, name, value, found) {
    at = index(reference, ":")
    file = substr(reference, 1, at - 1); column = substr(reference, at + 1)
    if (at = index(file, "@")) { which = substr(file, at + 1); file = substr(file, 1, at - 1) }
    file = "out/" file ".csv"
    if (list) { if (!(file in listed)) { listed[file] = 1; print file } return 1 }
    while ((getline line < file) > 0) {
        if (!n) { n = split_line(line, name); continue }
        split_line(line, value)
        split("", cell_of)
        for (i = 1; i <= n; i++) cell_of[name[i]] = value[i]
        if (which != "" && which !~ /^w/ && cell_of["cache_bytes"] != bytes(which)) continue
        if (which ~ /^w/ && cell_of["ways"] != substr(which, 2)) continue
        if (!(column in cell_of) || cell_of[column] == "") break
        found = 1
        break
    }
    close(file)
    if (!found) fail(file " has no " column (which == "" ? "" : " of " which))
    # Relative half widths of independent estimates add up in squares.
    if (cell_of[column] != 0) doubt += (cell_of[column "_error"] / cell_of[column]) ^ 2
    return cell_of[column]
}

function bytes(size,   n) {
    n = size + 0
    return size ~ /K$/ ? n * 1024 : size ~ /M$/ ? n * 1048576 : n
}

function value_of(word) {
    if (word ~ /\/.*:/) return result(word)
    if (word !~ /^[0-9.]+(e[0-9]+)?$/) fail("`" word "` is neither a number nor a result")
    return word + 0
}

# From left to right.
function evaluated(text,   word, n, i, sum, right) {
    n = split(text, word, " ")
    doubt = 0
    sum = value_of(word[1])
    for (i = 2; i < n; i += 2) {
        right = value_of(word[i + 1])
        if (word[i] == "*") sum *= right
        else if (word[i] == "/") { if (right == 0) fail("division by zero in " text); sum /= right }
        else if (word[i] == "-") sum -= right
        else fail("`" word[i] "` is none of * / -")
    }
    return sum
}

function holds(value, paper, rule,   word, limit) {
    split(rule, word, " ")
    if (word[1] == "<=") return value <= word[2] + 0
    if (word[1] == ">=") return value >= word[2] + 0
    if (word[1] == "within") return value <= paper * word[2] && value >= paper / word[2]
    if (split(rule, limit, "[.][.]") == 2) return value >= limit[1] + 0 && value <= limit[2] + 0
    fail("`" rule "` is no rule")
}

/^#/ { next }
{ split_line($0, cell) }
!headed++ { if (!list) print "id,section,claim,unit,paper,ours,ratio,rule,verdict,reason,how"; next }

{
    if (cell[7] == "none") {
        if (cell[8] == "") fail("a claim that is not decided needs a reason")
        verdict = "cannot be decided"; ours = ""; ratio = ""
    } else {
        value = evaluated(cell[6])
        if (list) next
        half = value * sqrt(doubt)
        low = holds(value - half, cell[5], cell[7]); high = holds(value + half, cell[5], cell[7])
        verdict = low && high ? "confirmed" : low || high || holds(value, cell[5], cell[7]) ? "cannot be decided" : "not confirmed"
        if (verdict == "cannot be decided") cell[8] = "the limit lies within the interval"
        ours = sprintf("%.4g", value) (doubt > 0 ? sprintf(" ± %.2g", half) : "")
        ratio = cell[5] == "" || cell[5] == 0 ? "" : sprintf("%.3g", value / cell[5])
    }
    if (!list) printf "%s,%s,\"%s\",%s,%s,%s,%s,%s,%s,\"%s\",\"%s\"\n", cell[1], cell[2], cell[3], cell[4], cell[5], ours, ratio, cell[7], verdict, cell[8], cell[6]
}
