#!/usr/bin/env bash
# On a clean Debian, as root: install the packages that lie beside this file, and use them as a newcomer would.
set -Eeuo pipefail
cd "$(dirname "$0")"
export DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1
case1=(lmp_cluster -in /usr/share/clusterdem/inputs/case1.in -var inputs /usr/share/clusterdem/inputs -var tend 0.0005)
last=case1.00000500.dump

apt-get -q -y update
apt-get -q -y install --no-install-recommends ./clusterdem_*.deb python3-venv
mkdir one two
(cd one && "${case1[@]}" && ls "$last")
(cd two && mpirun -np 2 "${case1[@]}" && ls "$last")
cmp <(sed 1,9d "one/$last" | cut -d' ' -f1,10) <(sed 1,9d "two/$last" | cut -d' ' -f1,10)

python3 -m venv post
post/bin/pip install -q ./clusterdem-*.whl
post/bin/clusterdem --version
post/bin/clusterdem sizes "one/$last"
apt-get -q -y remove clusterdem
! command -v lmp_cluster
echo "installed, run on one rank and on two with the same clusters, post-processed, removed"
