#!/bin/sh
# Runs the demonstration and all tests on a machine with only Rust and a linker: a minimal Debian in a folder, with a
# copy of this machine's default Rust toolchain without additional targets.
#
#   sudo xtask/fresh_machine.sh FOLDER [COMMAND]
#
# Creates FOLDER (10 GB) and keeps it; an existing one is reused. COMMAND replaces both and runs in a copy of the last
# commit. Needs Debian's debootstrap, rustup and a network.
set -eu

folder=${1:?"usage: sudo xtask/fresh_machine.sh FOLDER [COMMAND]"}
command=${2:-"cargo run --release && CI=1 cargo xtask test"}
suite=bookworm
repository=$(cd "$(dirname "$0")/.." && pwd)
toolchain=$(rustc --print sysroot)
name=$(basename "$toolchain")

if [ ! -d "$folder/root/.rustup" ]; then
    debootstrap --variant=minbase --include=ca-certificates,gcc,libc6-dev "$suite" "$folder"
    mkdir -p "$folder/root/.rustup/toolchains" "$folder/root/.cargo/bin"
    # The documentation is the largest part of a toolchain and is not needed.
    tar --create --directory "$(dirname "$toolchain")" --exclude "$name/share" "$name" |
        tar --extract --directory "$folder/root/.rustup/toolchains"
    cp -a "$(command -v rustup)" "$folder/root/.cargo/bin/rustup"
    for program in cargo rustc rustdoc rustfmt; do
        ln -s rustup "$folder/root/.cargo/bin/$program"
    done
    fresh=yes
fi

# Copies only committed files: others would be missing on another machine.
mkdir -p "$folder/dashpot"
git -C "$repository" archive HEAD | tar --extract --directory "$folder/dashpot"
# Copies the name servers, and the certificate authorities in case the network has its own.
cp /etc/resolv.conf "$folder/etc/resolv.conf"
cp /etc/ssl/certs/ca-certificates.crt "$folder/etc/ssl/certs/ca-certificates.crt"

# In a separate mount namespace, nothing stays mounted afterwards.
in_folder() {
    unshare --mount --pid --fork sh -c '
        mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" &&
        exec chroot "$1" /usr/bin/env -i HOME=/root TERM=dumb \
            PATH=/root/.cargo/bin:/usr/sbin:/usr/bin:/sbin:/bin sh -euc "cd /dashpot; $2"
    ' sh "$folder" "$1"
}

if [ "${fresh:-no}" = yes ]; then
    in_folder "rustup default $name
        host=\$(rustc --print host-tuple)
        for target in \$(rustup target list --installed); do
            [ \"\$target\" = \"\$host\" ] || rustup target remove \"\$target\"
        done"
fi
in_folder "$command"
