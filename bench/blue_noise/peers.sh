#!/usr/bin/env bash
# peers.sh CLONE OUT: builds samplers of others for bench_blue_noise into OUT. CLONE is a clone, bare or not, of
# UTK's public repository, https://github.com/utk-team/utk, with its history; nothing is fetched and nothing is
# written there. Of its version 1, the last commit before it was removed: FPO, which is the program fpo of
# T. Schloemer, D. Heck and O. Deussen. Of the present one: BNOT by F. de Goes and others, dart throwing, and Poisson
# disks by D. Dunbar. They need CGAL and SuiteSparse (./dev setup blue_noise_peers). One that cannot be built is a line.
set -uo pipefail
(($# == 2)) || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
readonly fpo_commit=59b1d9abd8781a67feff92b62e31e5c458753cfa # 2022
readonly utk_commit=2940c4c181d97a856569f2a5e5a6634e5c420f21 # 2024-08-23
clone=$(readlink -f "$1")
mkdir -p "$2"
cd "$2" || exit 1

# Of a clone that lacks some large files, too.
unpack() { # COMMIT FOLDER PATH...
    local commit=$1 folder=$2 path
    shift 2
    [[ -d $folder ]] && return
    rm -rf "$folder.part"
    git -C "$clone" ls-tree -r --name-only "$commit" -- "$@" | while IFS= read -r path; do
        mkdir -p "$folder.part/$(dirname "$path")"
        git -C "$clone" show "$commit:$path" >"$folder.part/$path" || { rm -rf "$folder.part" && break; }
    done
    mv "$folder.part" "$folder" 2>/dev/null && return
    echo "peers: no $folder: $clone lacks commit $commit" >&2
    return 1
}
compile() { # NAME COMPILER-ARGUMENT...
    local name=$1
    shift
    [[ libpeer_$name.so -nt $here/$name.cpp && libpeer_$name.so -nt $here/peers.sh ]] && return
    echo "peers: building $name, a minute" >&2
    "${CXX:-c++}" -std=c++17 -O3 -march=native -frounding-math -DNDEBUG -w -fPIC -shared \
        -I"$here" -o "libpeer_$name.so" "$@" >"$name.log" 2>&1 ||
        { rm -f "libpeer_$name.so"; echo "peers: no $name: $(grep -m 1 error "$name.log"); see $PWD/$name.log" >&2; }
}

# A constructor that newer CGALs find ambiguous gets the null that it means.
if unpack "$fpo_commit" fpo src/samplers/SamplerFPO src/pointsets src/io/messageStream.hpp; then
    sed -i 's/vertex(0)/vertex(nullptr)/' fpo/src/samplers/SamplerFPO/DT.h
    compile fpo -Ifpo/src "$here/fpo.cpp" fpo/src/samplers/SamplerFPO/DT.cpp -lgmp -lmpfr
fi
if unpack "$utk_commit" utk include/utk externals/PeriodicBNOT externals/FastPoisson; then
    compile utk -Iutk/include -Iutk/externals -I/usr/include/suitesparse "$here/utk.cpp" \
        utk/externals/FastPoisson/{PDSampling,RNG,RangeList,ScallopedSector}.cpp -lspqr -lcholmod -lgmp -lmpfr
fi
exit 0
