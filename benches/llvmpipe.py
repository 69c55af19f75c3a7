"""Times Mesa's llvmpipe and this renderer in turn; started by llvmpipe.sh."""

import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import moderngl
import numpy as np

SIZE = (1920, 1080)
SAMPLES = 4
REPEATS = int(sys.argv[1]) if len(sys.argv) > 1 else 11

VERTEX = """
#version 330
uniform mat4 clip_from_world, view_from_world;
in vec3 position, normal;
out vec3 point, direction;
void main() {
    vec4 clip = clip_from_world * vec4(position, 1.0);
    point = (view_from_world * vec4(position, 1.0)).xyz;
    direction = mat3(view_from_world) * normal;
    gl_Position = vec4(clip.xy, clip.w - 2.0 * clip.z, clip.w);
}
"""

# The studio look without shadows and ambient occlusion: two sides, three lights, highlights of the first.
FRAGMENT = """
#version 330
in vec3 point, direction;
out vec4 color;
const vec3 LIGHTS[3] = vec3[](vec3(-0.55, 0.65, 0.55), vec3(0.85, 0.10, 0.35), vec3(0.30, -0.80, 0.35));
const vec3 COLORS[3] = vec3[](vec3(0.80, 0.776, 0.736), vec3(0.096, 0.1056, 0.12), vec3(0.09, 0.081, 0.072));
const float WRAPS[3] = float[](0.2, 0.3, 0.3);
void main() {
    vec3 eye = normalize(-point);
    vec3 n = normalize(gl_FrontFacing ? direction : -direction);
    vec3 albedo = gl_FrontFacing ? vec3(0.745, 0.223, 0.047) : vec3(0.048, 0.209, 0.479);
    vec3 diffuse = mix(vec3(0.20, 0.18, 0.16), vec3(0.30, 0.33, 0.38), 0.5 + 0.5 * n.y);
    for (int k = 0; k < 3; ++k)
        diffuse += COLORS[k] * max((dot(n, normalize(LIGHTS[k])) + WRAPS[k]) / (1.0 + WRAPS[k]), 0.0);
    float h = max(dot(n, normalize(normalize(LIGHTS[0]) + eye)), 0.0);
    float h4 = h * h * h * h, h12 = h4 * h4 * h4, h60 = h12 * h12 * h12 * h12 * h12;
    float grazing = 1.0 - clamp(dot(n, eye), 0.0, 1.0);
    vec3 light = albedo * diffuse + COLORS[0] * (0.16 * h60 + 0.05 * h12);
    color = vec4(light * (1.0 - 0.55 * grazing * grazing * grazing), 1.0);
}
"""


class Peer:
    """llvmpipe with a mesh of its own; a frame is upload, drawing, resolve and read-back."""

    def __init__(self, context, folder, name):
        read = lambda kind, type: np.fromfile(os.path.join(folder, f"{name}.{kind}"), dtype=type)
        self.vertices = read("vertices", "<f4").tobytes()
        self.matrices = read("matrices", "<f4").reshape(-1, 2, 16)
        self.program = context.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT)
        self.buffer = context.buffer(reserve=len(self.vertices), dynamic=True)
        indices = context.buffer(read("indices", "<u4").tobytes())
        self.mesh = context.vertex_array(self.program, [(self.buffer, "3f 3f", "position", "normal")], indices)
        self.many = context.framebuffer(
            context.renderbuffer(SIZE, 4, samples=SAMPLES), context.depth_renderbuffer(SIZE, samples=SAMPLES)
        )
        self.one = context.framebuffer(context.renderbuffer(SIZE, 4))
        self.pixels = bytearray(SIZE[0] * SIZE[1] * 4)
        self.context = context

    def time(self, view):
        start = time.perf_counter()
        self.buffer.orphan()
        self.buffer.write(self.vertices)
        clip, to_view = self.matrices[view % len(self.matrices)]
        self.program["clip_from_world"].write(clip.tobytes())
        self.program["view_from_world"].write(to_view.tobytes())
        self.many.use()
        self.many.clear(0.9, 0.9, 0.87, 1.0)
        self.mesh.render()
        self.context.copy_framebuffer(self.one, self.many)
        self.one.read_into(self.pixels, components=4)
        return (time.perf_counter() - start) * 1e3


class Ours:
    """The bench of this crate, which renders on demand."""

    def __init__(self, folder):
        command = ["cargo", "bench", "-q", "--locked", "--bench", "render", "--", "serve", folder]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout.readline().strip() == "ready"

    def time(self, name, view):
        self.process.stdin.write(f"{name} {view}\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())


def main():
    with tempfile.TemporaryDirectory() as folder:
        ours = Ours(folder)
        context = moderngl.create_context(standalone=True, backend="egl")
        context.enable(moderngl.DEPTH_TEST)
        machine = next((l.split(":")[1].strip() for l in open("/proc/cpuinfo") if "model name" in l), platform.machine())
        print(f"{machine}, {len(os.sched_getaffinity(0))} cores, load {os.getloadavg()[0]:.1f}")
        print(f"{context.info['GL_RENDERER']}, {context.info['GL_VERSION']}")
        print(f"{SIZE[0]} x {SIZE[1]}, {SAMPLES} samples, median of {REPEATS} frames, milliseconds (least to most)")
        print(f"{'triangles':>10} {'immerse':>24} {'llvmpipe':>24} {'ratio':>6}")
        for name in ["30k", "1M"]:
            peer = Peer(context, folder, name)
            times = ([], [])
            for repeat in range(-2, REPEATS):
                pair = ours.time(name, repeat % 12), peer.time(repeat % 12)
                if repeat >= 0:
                    times[0].append(pair[0])
                    times[1].append(pair[1])
            cell = lambda t: f"{statistics.median(t):.0f} ({min(t):.0f} to {max(t):.0f})"
            ratio = statistics.median(times[0]) / statistics.median(times[1])
            print(f"{name:>10} {cell(times[0]):>24} {cell(times[1]):>24} {ratio:>6.2f}", flush=True)
            if len(sys.argv) > 2:
                picture = np.frombuffer(peer.pixels, np.uint8).reshape(SIZE[1], SIZE[0], 4)[::-1]
                np.save(os.path.join(sys.argv[2], f"{name}.npy"), picture)
        studio = [ours.time("30k-studio", view) for view in range(6)][1:]
        print(f"30k with shadows, ambient occlusion and lines: {statistics.median(studio):.0f} ms")
        ours.process.stdin.close()


main()
