# CSV for the other scripts: awk -f scripts/csv.awk -f scripts/join.awk ...

# Splits a line into cell[1..] and returns how many there are; quotes are doubled within quotes.
function split_line(line, cell,   n, i, c, quoted, text) {
    split("", cell)
    for (i = 1; i <= length(line); i++) {
        c = substr(line, i, 1)
        if (quoted && c == "\"" && substr(line, i + 1, 1) == "\"") { text = text c; i++ }
        else if (c == "\"") quoted = !quoted
        else if (c == "," && !quoted) { cell[++n] = text; text = "" }
        else text = text c
    }
    cell[++n] = text
    return n
}

# A cell as a line has it.
function quoted(text) {
    if (text !~ /[",]/) return text
    gsub(/"/, "\"\"", text)
    return "\"" text "\""
}
