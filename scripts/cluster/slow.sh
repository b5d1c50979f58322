#!/usr/bin/env bash
# slow.sh COMMAND...: the command, after SLOW seconds; for tests that have to meet it while it runs.
sleep "${SLOW:-0}"
exec "$@"
