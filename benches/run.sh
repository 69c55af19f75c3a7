#!/bin/sh
# Times the program, the paper's method in NumPy/SciPy and CHOLMOD on the same problems, prints tables and writes RESULTS.md:
#     benches/run.sh [--mesh bunny.obj] [--quick] [--out FILE] [PART …]
# Installs what is missing: Debian or Ubuntu packages, as root; Python packages at fixed versions into a folder of the build.
set -eu
cd "$(dirname "$0")/.."
# The last scikit-sparse that builds with the SuiteSparse of Debian 12.
packages="numpy==2.4.6 scipy==1.17.1 scikit-sparse==0.4.16"
if ! [ -e /usr/include/suitesparse/cholmod.h ] || ! ldconfig -p | grep -q libopenblas; then
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends gcc libsuitesparse-dev libopenblas0-pthread
fi
python=target/bench-python
[ -x $python/bin/python ] || python3 -m venv $python
[ "$(cat $python/packages 2>/dev/null)" = "$packages" ] || {
    $python/bin/pip install -q $packages
    echo "$packages" > $python/packages
}
exec $python/bin/python benches/run.py "$@"
