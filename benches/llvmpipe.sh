#!/bin/sh
# Compares the renderer with Mesa's software rasterizer llvmpipe on the same mesh and cameras, frame by frame in turn:
#     benches/llvmpipe.sh
# Installs what is missing (Debian or Ubuntu packages, as root; Python packages into a folder of the build).
set -eu
cd "$(dirname "$0")/.."
if ! ldconfig -p | grep -q libEGL_mesa; then
    apt-get update -qq
    apt-get install -y -qq --no-install-recommends libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri
fi
python=target/llvmpipe
[ -x $python/bin/python ] || python3 -m venv $python
$python/bin/python -c 'import moderngl, numpy' 2>/dev/null || $python/bin/pip install -q moderngl numpy
cargo bench --locked --bench render --no-run
exec env EGL_PLATFORM=surfaceless LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe $python/bin/python benches/llvmpipe.py "$@"
