# Sourced by the scripts of points: where the room whose name is in `room` is, and what it takes to load it.
# shellcheck shell=bash disable=SC2034,SC2154
scene=scenes/$room.obj
[ -e "$scene" ] || scene=out/scenes/$room.obj
load=("$scene")
case $room in *glossy*) load+=(--glossy) ;; esac
