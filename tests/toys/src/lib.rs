//! What a contributor touches for each of the five kinds of addition, shown by a test each in `tests/`: a toy order, map,
//! cache policy, import and export, each one file and one line, found by every test that says "for every".
