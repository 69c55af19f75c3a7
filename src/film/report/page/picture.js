// One picture of a frame, by WebGL 2: the surface, its lines and its shadows, see-through layer by layer.

const VERSION = "#version 300 es\nprecision highp float;\nprecision highp int;\n#define FILTER 1.5\n";
/** Sheets behind each other that are told apart where the surface is see-through. */
const LAYERS = 10;
const SHADOW_SIDE = 1024;
/** More samples than this are not drawn, however large the picture is. */
const MOST_SAMPLES = 5e6;

class Picture {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, preserveDrawingBuffer: true, powerPreference: "high-performance" });
    if (!gl) throw new Error("there is no WebGL 2");
    this.gl = gl;
    this.canvas = canvas;
    this.light16 = Boolean(gl.getExtension("EXT_color_buffer_float") || gl.getExtension("EXT_color_buffer_half_float"));
    this.programs = Object.fromEntries(Object.entries(SHADERS).map(([name, sources]) => [name, this.program(name, sources)]));
    this.tables = {};
    this.targets = {};
    this.empty = gl.createVertexArray();
    this.segments = this.lineBuffers();
  }

  program(name, sources) {
    const { gl } = this;
    const program = gl.createProgram();
    sources.forEach((source, k) => {
      const shader = gl.createShader(k === 0 ? gl.VERTEX_SHADER : gl.FRAGMENT_SHADER);
      gl.shaderSource(shader, VERSION + source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
    });
    if (name === "lines") ["from", "to"].forEach((attribute, k) => gl.bindAttribLocation(program, k, attribute));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`${name}: ${gl.getProgramInfoLog(program)}`);
    const uniforms = {};
    for (let k = 0; k < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); k++) {
      const { name: full, type, size } = gl.getActiveUniform(program, k);
      uniforms[full.replace("[0]", "")] = { place: gl.getUniformLocation(program, full), type, size };
    }
    return { program, uniforms };
  }

  /** Uses a program with these values; textures are bound in their order. */
  use(name, values) {
    const { gl } = this;
    const { program, uniforms } = this.programs[name];
    gl.useProgram(program);
    let unit = 0;
    for (const [key, { place, type }] of Object.entries(uniforms)) {
      const value = values[key];
      if (value === undefined) throw new Error(`${name} wants ${key}`);
      if (type === gl.SAMPLER_2D || type === gl.UNSIGNED_INT_SAMPLER_2D) {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, value);
        gl.uniform1i(place, unit++);
      } else if (type === gl.FLOAT) gl.uniform1fv(place, [value].flat());
      else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, value.flat());
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, value.flat());
      else if (type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(place, false, value);
      else gl.uniform1iv(place, [value].flat().map(Number)); // numbers and truth values
    }
  }

  /** A texture that holds an array, with so many numbers an entry. */
  table(name, array, channels, kind) {
    const { gl } = this;
    const width = Math.min(2048, gl.getParameter(gl.MAX_TEXTURE_SIZE));
    const count = array.length / channels;
    const height = Math.max(1, Math.ceil(count / width));
    const [internal, format, type] = {
      float: [gl.RGBA32F, gl.RGBA, gl.FLOAT],
      uint: [gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT],
      two: [gl.RG8, gl.RG, gl.UNSIGNED_BYTE],
      one: [gl.R8, gl.RED, gl.UNSIGNED_BYTE],
    }[kind];
    const padded = new array.constructor(width * height * channels);
    padded.set(array);
    this.tables[name] ??= gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.tables[name]);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, padded);
    this.sampling(gl.NEAREST);
    return this.tables[name];
  }

  sampling(filter) {
    const { gl } = this;
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  }

  /** 256 colours between those of a map, or its colours themselves. */
  colors(map, categories) {
    const { gl } = this;
    const count = categories ? map.length : 256;
    const texels = new Float32Array(4 * count);
    for (let k = 0; k < count; k++) {
      const place = categories ? k : (k / 255) * (map.length - 1);
      const low = Math.min(Math.floor(place), map.length - 2);
      for (let c = 0; c < 3; c++) texels[4 * k + c] = map[low][c] + (map[low + 1][c] - map[low][c]) * (place - low);
    }
    this.tables.colors ??= gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.tables.colors);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, count, 1, 0, gl.RGBA, gl.FLOAT, texels);
    this.sampling(gl.LINEAR);
  }

  /** A target of this size: light, depth or both. */
  target(name, width, height, light, depth) {
    const { gl } = this;
    const old = this.targets[name];
    if (old && old.width === width && old.height === height) return old;
    if (old) {
      gl.deleteTexture(old.light);
      gl.deleteTexture(old.depth);
      gl.deleteFramebuffer(old.frame);
    }
    const texture = (internal, format, type) => {
      const made = gl.createTexture();
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, made);
      gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, null);
      this.sampling(gl.NEAREST);
      return made;
    };
    const made = { width, height, frame: gl.createFramebuffer() };
    gl.bindFramebuffer(gl.FRAMEBUFFER, made.frame);
    if (light) {
      made.light = this.light16 ? texture(gl.RGBA16F, gl.RGBA, gl.HALF_FLOAT) : texture(gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, made.light, 0);
    }
    if (depth) {
      made.depth = texture(gl.DEPTH_COMPONENT24, gl.DEPTH_COMPONENT, gl.UNSIGNED_INT);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, made.depth, 0);
    }
    return (this.targets[name] = made);
  }

  /** Draws upon a target that is cleared first. */
  begin(target, clear = true) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
    gl.viewport(0, 0, target.width, target.height);
    if (clear) {
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    }
  }

  lineBuffers() {
    const { gl } = this;
    const array = gl.createVertexArray();
    const buffer = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    [0, 1].forEach((k) => {
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, 3, gl.FLOAT, false, 24, 12 * k);
      gl.vertexAttribDivisor(k, 1);
    });
    return { array, buffer };
  }

  triangles(faces) {
    const { gl } = this;
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * faces);
  }

  /** What of the surface is nearest in each sample: depths first, so that nothing is shaded that is not seen. */
  nearest(surface, faces) {
    const { gl } = this;
    gl.colorMask(false, false, false, false);
    this.use("surface", { ...surface, depth_alone: true });
    this.triangles(faces);
    gl.colorMask(true, true, true, true);
    gl.depthFunc(gl.EQUAL);
    this.use("surface", { ...surface, depth_alone: false });
    this.triangles(faces);
    gl.depthFunc(gl.LESS);
  }

  /** Lines of a kind: segments with ends in the space of the film. */
  lines({ segments, width, color, outline = false, raised = false }, common) {
    if (segments.length === 0 || width === 0) return;
    const { gl } = this;
    const wide = common.line_unit * width;
    this.use("lines", {
      ...common, radius: outline ? wide : wide / 2, sink: outline ? wide : 0, outline, line_color: color, raised_line: raised,
    });
    gl.bindVertexArray(this.segments.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.segments.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, segments, gl.STREAM_DRAW);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, segments.length / 6);
  }

  /**
   * Draws a frame whose tables are set. `view` is from the camera; `look` says how; `lines` come in their order; `ball` is
   * what the surface lies in.
   */
  draw({ view, look, lines, faces, ball, fine }) {
    const { gl, canvas } = this;
    const pixels = canvas.width * canvas.height;
    const scale = Math.min(fine ? 2 : 1, Math.max(1, Math.sqrt(MOST_SAMPLES / pixels)));
    const [width, height] = [canvas.width, canvas.height].map((side) => Math.max(1, Math.round(scale * side)));
    const key = facts.lights.findIndex((light) => light.shadow);
    const casts = look.shadows && look.lit && key >= 0;
    const common = {
      turn: view.turn, shift: view.shift, half_height: view.half, aspect: view.aspect, near: view.near, far: view.far,
      perspective: view.perspective, size: [width, height], samples: scale,
      light_count: facts.lights.length,
      light_toward: facts.lights.map((light) => light.toward), light_color: facts.lights.map((light) => light.color),
      light_wrap: facts.lights.map((light) => light.wrap), light_shadow: facts.lights.map((light) => light.shadow),
      sky_light: look.sky, ground_light: look.ground, rim_darkening: look.rimDarkening,
      // Lines are as wide as in the pictures of the film: in proportion to the picture, but not too thin.
      line_unit: scale * Math.max(0.4, Math.sqrt(pixels / (1920 * 1080))),
      ...this.tables,
      ...shadowAxes(casts ? facts.lights[key].toward : [0, 0, 1], view, ball),
    };
    const shadow = this.target("shadow", SHADOW_SIDE, SHADOW_SIDE, false, true);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    if (casts) {
      this.begin(shadow);
      this.use("shadow", common);
      this.triangles(faces);
    }
    const opaque = this.target("opaque", width, height, true, true);
    const surface = {
      ...common, sides: look.sides, lit: look.lit, gloss: look.gloss, occlusion: look.occlusion, opacity: look.opacity,
      edge_opacity: look.edgeOpacity, wireframe: look.wireframe, painted: look.painted, categories: look.categories,
      line_color: look.lineColor, casts, shadow: casts ? shadow.depth : this.tables.skies, layer: -1,
      nearer: this.tables.skies, opaque: this.tables.skies,
    };
    const isOpaque = look.opacity.every((x) => x === 1) && look.edgeOpacity === 1;
    this.begin(opaque);
    if (isOpaque) {
      this.nearest(surface, faces);
    }
    for (const kind of lines) this.lines(kind, common);
    const picture = isOpaque ? opaque : this.peeled(surface, opaque, faces, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.disable(gl.DEPTH_TEST);
    this.use("pixels", {
      picture: picture.light, scale: [width / canvas.width, height / canvas.height], size: [canvas.width, canvas.height],
      background: look.background, lit: look.lit,
    });
    gl.bindVertexArray(this.empty);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** Sheets from front to back, the next one in each sample at a time, and at last what is opaque. */
  peeled(surface, opaque, faces, width, height) {
    const { gl } = this;
    const layers = ["even", "odd"].map((name) => this.target(name, width, height, true, true));
    const sum = this.target("sum", width, height, true, false);
    this.begin(sum);
    const lay = (light) => {
      this.begin(sum, false);
      gl.disable(gl.DEPTH_TEST);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE_MINUS_DST_ALPHA, gl.ONE);
      this.use("layer", { picture: light });
      gl.bindVertexArray(this.empty);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      gl.disable(gl.BLEND);
      gl.enable(gl.DEPTH_TEST);
    };
    for (let layer = 0; layer < LAYERS; layer++) {
      const [mine, before] = [layers[layer % 2], layers[(layer + 1) % 2]];
      this.begin(mine);
      // A texture cannot be read while it is drawn upon; the first layer asks for none.
      this.nearest({ ...surface, layer, nearer: layer > 0 ? before.depth : surface.nearer, opaque: opaque.depth }, faces);
      lay(mine.light);
    }
    lay(opaque.light);
    return sum;
  }
}

/** The view of a light that is fixed to the eye, upon the ball that the surface lies in. */
function shadowAxes(toward, view, ball) {
  const [x, y, z] = toward;
  const length = Math.hypot(x, y, z);
  const n = [x / length, y / length, z / length];
  const helper = Math.abs(n[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const right = cross(helper, n);
  const size = Math.hypot(...right);
  const across = right.map((c) => c / size);
  return {
    shadow_x: across, shadow_y: cross(n, across), shadow_z: n, shadow_radius: 1.01 * ball.radius,
    shadow_middle: matrix.apply(view.turn, ball.middle).map((c, k) => c + view.shift[k]),
  };
}
