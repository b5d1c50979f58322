# Joins the rows of a sweep's points into one table, the labels of each point in front:
#   awk -v list=1 -f scripts/csv.awk -f scripts/sweep.awk ... | awk -f scripts/csv.awk -f scripts/join.awk
# A column of the same name as a label gives way to the label. Rows may have different columns: all are kept, empty where a row has none.

BEGIN { FS = "," }

NR == 1 { labels = split($0, label, ","); for (i = 2; i <= labels; i++) is_label[label[i]] = 1; next }

{
    file = $1
    front = substr($0, length(file) + 2)
    rows = 0
    while ((got = (getline line < file)) > 0) {
        if (rows++ == 0) { n = split_line(line, name); continue }
        split_line(line, cell)
        record[++records] = front
        for (i = 1; i <= n; i++) if (!(name[i] in is_label)) {
            if (!(name[i] in number)) { number[name[i]] = ++columns; column[columns] = name[i] }
            value[records, number[name[i]]] = quoted(cell[i])
        }
    }
    close(file)
    if (got < 0 || rows < 2) { print "join.awk: " file " has no row: remove it and run again" > "/dev/stderr"; failed = 1; exit 1 }
}

END {
    if (failed) exit 1
    line = label[2]
    for (i = 3; i <= labels; i++) line = line "," label[i]
    for (i = 1; i <= columns; i++) line = line "," column[i]
    print line
    for (r = 1; r <= records; r++) {
        line = record[r]
        for (i = 1; i <= columns; i++) line = line "," value[r, i]
        print line
    }
}
