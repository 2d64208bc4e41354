# The rooms of host/ from the lowest to the highest, for check_layers.sh and check_circles.sh, which source this.
# shellcheck shell=bash disable=SC2034 # what sources it uses them
# A folder inside a room that is not named here counts as its room.
rooms=(
    base ranks math math/random math/linear device files fields store points plots images meshes
    samplers samplers/torus samplers/sphere samplers/darts samplers/optimized samplers/ccvt samplers/forces sets integrands frequencies
    engines engines/host engines/nufft engines/torus engines/torus/nufft engines/sphere engines/sphere/nufft
    engines/pairs trials plan spectra rules
)

# Adds a room, those of its folders that are named, which others use, and then the rest, which use none of each other.
add_room() { # ROOM FOLDER...
    local room=$1 folder
    rooms+=("$room" "${@:2}")
    for folder in host/"$room"/*/; do
        folder=${folder#host/}
        [[ " ${rooms[*]} " == *" ${folder%/} "* ]] || rooms+=("${folder%/}")
    done
}
add_room jobs jobs/rows jobs/spectrum jobs/quadrature
rooms+=(request verify verify/bench)
add_room answers answers/points answers/ranges answers/spectra answers/quadrature answers/homogeneity answers/interpolation answers/parts answers/devices
rooms+=(scene scene/run commands api cli cli/commands)

# A room's table names what is in its folders, which are rooms above it: these sources alone look up.
tables=(answers/kinds.c engines/engines.c samplers/samplers.c)

declare -A rank=()
for i in "${!rooms[@]}"; do
    rank[${rooms[i]}]=$i
done

# The longest room that the path lies in, or nothing.
room_of() {
    local folder=$1
    while [[ $folder == */* ]]; do
        folder=${folder%/*}
        [[ -z ${rank[$folder]+known} ]] || { room=$folder && return; }
    done
    room=""
}
