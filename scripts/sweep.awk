# Turns a table of experiments into make rules, one target a point:
#   awk -v sweep=structures -f scripts/csv.awk -f scripts/sweep.awk scripts/words.csv scripts/sweeps/structures.csv > rules.mk
# or, with -v list=1, into the table of its points and their labels, in order (for scripts/join.awk).
#
# A table is CSV with a line of names. These columns are stages of the pipe, and empty if nothing is to be said:
#   scene    what pm-photons and pm-queries render: an OBJ file and options of both
#   photons  options of pm-photons          queries  options of pm-queries
#   stream   what queries go through before they are gathered, such as `pm-reorder hilbert --per batch`
#   gather   options of pm-gather           cache    options of pm-cachesim
#   command  what prints the rows instead of the pipe `queries | stream | pm-gather | pm-cachesim`; it may use {photons}
#            and {queries}, the files, and {out}, the target's name without `.csv`
#   needs    further files that must be there first
#   point    the point's name; without it, its labels joined by dots
# Every other column is a label: a list of words, and the line stands for a point for each of them (of several labels, for
# each combination). {label} stands for the word wherever it is written, and scripts/words.csv says what a word adds to a
# stage, unless there is a dash. $(NAME) is the value of a variable that make exports. Lines that begin with # are remarks.
#
# What several points have in common is made once: photons, and queries with all that follows them in their column, such as
# `--order tiled | pm-sample --batches 16`. Where others begin with the same queries, `||` instead of `|` keeps these too.

BEGIN {
    split("scene photons queries stream gather cache", names, " ")
    for (i in names) stage[names[i]] = 1
    stage["command"] = stage["needs"] = stage["point"] = 1
}

function fail(why) {
    print FILENAME ":" FNR ": " why > "/dev/stderr"
    failed = 1
    exit 1
}

FNR == 1 { file++ }
/^#/ || /^[ \t]*$/ { next }
{ sub(/\r$/, ""); cells = split_line($0, cell) }

# The line of names.
file != named { named = file; columns = cells; for (i = 1; i <= cells; i++) column[i] = cell[i]; next }

{ for (i = 1; i <= cells; i++) cell[i] = expanded(cell[i]) }

file == 1 { meaning[cell[1], cell[2], cell[3]] = cell[4]; known[cell[1], cell[2]] = vocabulary[cell[1]] = 1; next }

cells > columns { fail("has " cells " cells, and there are " columns " columns") }

{
    split("", given); labels = 0
    for (i = 1; i <= columns; i++) {
        if (column[i] in stage) given[column[i]] = cell[i]
        else { label[++labels] = column[i]; words[labels] = cell[i] }
    }
    if (list && !headed++) {
        line = "file,point"
        for (i = 1; i <= labels; i++) line = line "," label[i]
        print line
    }
    expand(1)
}

# A point for each combination of words, those of the last label changing fastest.
function expand(at,   list_of, n, i) {
    if (at > labels) { point(); return }
    n = split(words[at], list_of, " ")
    if (n == 0) { list_of[1] = ""; n = 1 }
    for (i = 1; i <= n; i++) { word[at] = list_of[i]; expand(at + 1) }
}

function filled(text,   i) {
    for (i = 1; i <= labels; i++) text = replace(text, "{" label[i] "}", word[i])
    return text
}

function replace(text, what, by,   at, done) {
    while (at = index(text, what)) { done = done substr(text, 1, at - 1) by; text = substr(text, at + length(what)) }
    return done text
}

# With the values of the variables that make exports.
function expanded(text,   name) {
    while (match(text, /[$][(][A-Za-z_]+[)]/)) {
        name = substr(text, RSTART + 2, RLENGTH - 3)
        if (!(name in ENVIRON)) fail("$(" name ") has no value: export it")
        text = substr(text, 1, RSTART - 1) ENVIRON[name] substr(text, RSTART + RLENGTH)
    }
    return text
}

# An option goes to the stage's own program, which is the first of a pipe; a program goes to the end.
function add(s, text, more,   at) {
    if (s == "stream") return with(text, more, " | ")
    at = index(text, "|")
    return at ? substr(text, 1, at - 1) more " " substr(text, at) : with(text, more, " ")
}

function with(text, more, between) { return text == "" || more == "" ? text more : text between more }

# A file name from options: what is no letter or digit is a dash.
function slug(text,   i, c, name) {
    gsub(/^ +| +$/, "", text)
    for (i = 1; i <= length(text); i++) {
        c = substr(text, i, 1)
        name = name (c ~ /[A-Za-z0-9._]/ ? c : "-")
    }
    gsub(/--+/, "-", name)
    gsub(/^-|-$/, "", name)
    return name == "" ? "default" : name
}

function point(   s, i, name, text, out, photons_file, queries_file, needs, scene_needs, pipe, parts, n) {
    for (s in stage) text[s] = given[s] == "-" ? "" : filled(given[s])
    # Stages that words add to, labels in the order of the columns.
    for (i = 1; i <= labels; i++) {
        for (s in stage) if ((label[i], word[i], s) in meaning)
            if (given[s] != "-") text[s] = add(s, text[s], filled(meaning[label[i], word[i], s]))
        if (label[i] in vocabulary && !((label[i], word[i]) in known)) fail("`" word[i] "` is no " label[i] " that scripts/words.csv knows")
    }
    name = text["point"]
    if (name == "") for (i = 1; i <= labels; i++) name = with(name, word[i], ".")
    if (name in points) fail("the point " name " stands twice in the table")
    points[name] = 1
    out = "out/" sweep "/" name
    if (list) {
        line = out ".csv," name
        for (i = 1; i <= labels; i++) line = line "," quoted(word[i])
        print line
        return
    }
    if (index(text["command"] text["queries"] text["scene"] text["stream"] text["gather"] text["cache"], "'")) fail("no ' may stand in a table")

    scene_needs = ""
    n = split(text["scene"], parts, " ")
    for (i = 1; i <= n; i++) if (parts[i] ~ /\.obj$/) scene_needs = scene_needs " " parts[i]
    photons_file = "out/streams/" slug(text["scene"] " " text["photons"]) ".pmp"
    # What guides gather rays is in the name too.
    queries_file = queries_name(text["scene"], text["queries"], text["photons"])
    text["stream"] = replace(text["stream"], "{photons}", photons_file)

    # What looks like a variable of make's is the shell's.
    pipe = replace(text["command"], "$", "$$")
    if (pipe == "") {
        pipe = text["stream"] == "" ? "pm-gather -q {photons} {queries}" : "< {queries} " text["stream"] " | pm-gather -q {photons}"
        pipe = pipe " -t $(THREADS)" (text["gather"] == "" ? "" : " " text["gather"]) \
            " | pm-cachesim -q --format csv" (text["cache"] == "" ? "" : " " text["cache"])
    }
    needs = text["needs"]
    if (index(pipe text["queries"], "{photons}")) {
        needs = needs " " photons_file
        stream_rule(photons_file, scene_needs, "pm-photons", text["scene"], text["photons"])
    }
    if (index(pipe, "{queries}")) {
        needs = needs " " queries_file
        if (index(text["queries"], "{photons}")) scene_needs = scene_needs " " photons_file
        queries_rule(queries_file, scene_needs, text["scene"], text["queries"], text["photons"], photons_file)
    }
    pipe = replace(replace(replace(pipe, "{photons}", photons_file), "{queries}", queries_file), "{out}", out)
    print out ".csv: " needs " | programs"
    print "\t$(call row," replace(pipe, ",", "$(comma)") ")"
    all = all " \\\n    " out ".csv"
}

function queries_name(scene, queries, photons) {
    return "out/streams/" slug(scene " " replace(queries, "{photons}", slug(photons))) ".pmq"
}

# The rule of queries, and of those that they begin with if these are kept.
function queries_rule(file, needs, scene, queries, photons, photons_file,   at, first, kept) {
    if (at = index(queries, "||")) {
        first = substr(queries, 1, at - 1)
        kept = queries_name(scene, first, photons)
        queries_rule(kept, needs, scene, first, photons, photons_file)
        rule(file, " " kept needs, "< " kept replace(substr(queries, at + 2), "{photons}", photons_file))
    } else stream_rule(file, needs, "pm-queries", scene, replace(queries, "{photons}", photons_file))
}

function stream_rule(file, needs, program, scene, options,   at, then) {
    if (at = index(options, "|")) { then = " " substr(options, at); options = substr(options, 1, at - 1) }
    rule(file, needs, program " -q " scene " " options " -t $(THREADS)" then)
}

# The rule of a stream; another table may have the same.
function rule(file, needs, pipe) {
    if (file in ruled) return
    ruled[file] = 1
    print "ifndef RULE." file
    print "RULE." file " := 1"
    print file ":" needs " | programs"
    print "\t$(call stream," replace(pipe, ",", "$(comma)") ")"
    # Rows outlive it: without it, it is made again only for rows that are missing.
    print ".SECONDARY: " file
    print "endif"
}

END {
    if (failed) exit 1
    if (!headed && !all) { print "there is no point in " FILENAME > "/dev/stderr"; exit 1 }
    if (!list) print "POINTS." sweep " :=" all
}
