// What the graphics processor does. The shading, its numbers and the projection are those of the film's own pictures.

const PROJECT = `
uniform mat3 turn;
uniform vec3 shift;
uniform float half_height, aspect, near, far;
uniform bool perspective;
uniform vec2 size;               // of the picture in samples

vec3 seen(vec3 place) { return turn * place + shift; }

/** Clip space of a place in view space. */
vec4 projected(vec3 v) {
  vec2 flat_place = v.xy / vec2(half_height * aspect, half_height);
  if (!perspective) return vec4(flat_place, 2.0 * (-v.z - near) / (far - near) - 1.0, 1.0);
  return vec4(flat_place, (-v.z * (far + near) - 2.0 * far * near) / (far - near), -v.z);
}

/** What a sample spans at a place in view space. */
float sample_size(vec3 v) { return 2.0 * half_height * (perspective ? -v.z : 1.0) / size.y; }
`;

const LIGHT = `
uniform int light_count;
uniform vec3 light_toward[8], light_color[8];
uniform float light_wrap[8];
uniform bool light_shadow[8];
uniform vec3 sky_light, ground_light;
uniform float rim_darkening;

float lobes(float c) { return 0.16 * pow(c, 60.0) + 0.05 * pow(c, 12.0); }

vec3 occluded(float sky, vec3 albedo) {
  float open = pow(max(sky, 0.0), 1.5);
  return vec3(open) / max(vec3(open) + (1.0 - open) * (1.0 - 0.35 * albedo), vec3(1e-6));
}

/** Light in the colour of the surface, and what is reflected off its skin. */
void leaving(vec3 albedo, vec3 normal, vec3 eye, float sky, float gloss, float share, out vec3 body, out vec3 highlight) {
  vec3 diffuse = mix(ground_light, sky_light, 0.5 + 0.5 * normal.y) * occluded(sky, albedo);
  highlight = vec3(0.0);
  for (int k = 0; k < light_count; k++) {
    float cosine = dot(normal, light_toward[k]);
    float lambert = (cosine + light_wrap[k]) / (1.0 + light_wrap[k]);
    if (lambert <= 0.0) continue;
    float arrives = light_shadow[k] ? share : 1.0;
    diffuse += light_color[k] * lambert * (0.1 + 0.9 * arrives);
    if (light_shadow[k] && cosine > 0.0) {
      vec3 halfway = normalize(light_toward[k] + eye);
      highlight += light_color[k] * gloss * lobes(max(dot(normal, halfway), 0.0)) * arrives * min(4.0 * cosine, 1.0);
    }
  }
  float grazing = 1.0 - clamp(dot(normal, eye), 0.0, 1.0);
  float rim = 1.0 - rim_darkening * grazing * grazing * grazing;
  body = albedo * diffuse * rim;
  highlight *= min(rim, 1.0);
}
`;

const FETCH = `
uniform highp sampler2D places, normals;
uniform highp usampler2D faces;
vec4 entry(highp sampler2D table, uint k) { int w = textureSize(table, 0).x; return texelFetch(table, ivec2(int(k) % w, int(k) / w), 0); }
uvec4 entry(highp usampler2D table, uint k) { int w = textureSize(table, 0).x; return texelFetch(table, ivec2(int(k) % w, int(k) / w), 0); }
`;

const SHADERS = {
  surface: [`
${PROJECT}${FETCH}
uniform sampler2D skies, values;
uniform int painted;             // 0 by side, 1 by a value of each face, 2 of each vertex
flat out vec3 c0, c1, c2, n0, n1, n2, lengths;
out vec3 weights, at, normal;
out vec2 sky;
out float value;
void main() {
  uint face = uint(gl_VertexID / 3);
  int k = gl_VertexID % 3;
  uvec4 corners = entry(faces, face);
  c0 = seen(entry(places, corners.x).xyz); c1 = seen(entry(places, corners.y).xyz); c2 = seen(entry(places, corners.z).xyz);
  n0 = turn * entry(normals, corners.x).xyz; n1 = turn * entry(normals, corners.y).xyz; n2 = turn * entry(normals, corners.z).xyz;
  uint vertex = corners[k];
  weights = vec3(k == 0, k == 1, k == 2);
  at = k == 0 ? c0 : k == 1 ? c1 : c2;
  normal = k == 0 ? n0 : k == 1 ? n1 : n2;
  sky = entry(skies, vertex).xy;
  value = entry(values, painted == 1 ? face : vertex).x;
  vec4 p0 = projected(c0), p1 = projected(c1), p2 = projected(c2);
  vec2 q0 = p0.xy / p0.w, q1 = p1.xy / p1.w, q2 = p2.xy / p2.w;
  lengths = 0.5 * vec3(length((q1 - q0) * size), length((q2 - q1) * size), length((q0 - q2) * size));
  gl_Position = projected(at);
}`, `
${LIGHT}
uniform vec3 sides[2];
uniform bool lit, perspective, categories;
uniform float gloss, occlusion, edge_opacity, wireframe, samples;
uniform vec2 opacity;
uniform int painted;
uniform sampler2D colors;
uniform vec3 line_color;
uniform bool casts;
uniform highp sampler2D shadow;
uniform vec3 shadow_x, shadow_y, shadow_z, shadow_middle;
uniform float shadow_radius;
uniform int layer;               // -1 where everything is opaque
uniform highp sampler2D nearer, opaque;
uniform bool depth_alone;
flat in vec3 c0, c1, c2, n0, n1, n2, lengths;
in vec3 weights, at, normal;
in vec2 sky;
in float value;
out vec4 color;

vec3 painted_color(int side) {
  if (painted == 0) return sides[side];
  float code = floor(255.0 * value + 0.5);
  if (painted == 2) code = min(255.0 * value, 254.0);
  if (categories) return texelFetch(colors, ivec2(code >= 1.0 ? 1 + (int(code) - 1) % 9 : 0, 0), 0).rgb;
  if (painted == 1 && code > 254.0) return vec3(0.4);
  return texture(colors, vec2((code / 254.0 * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}

/** Share of the key light that arrives, from the depths that it sees. */
float light_seen(vec3 place, vec3 n) {
  vec3 toward = shadow_z;
  float rise = dot(n, toward);
  vec3 from = (place + n * 0.006 * shadow_radius + n * max(0.15 - rise, 0.0) * 0.04 * shadow_radius - shadow_middle) / shadow_radius;
  vec3 mine = vec3(dot(from, shadow_x), dot(from, shadow_y), dot(from, toward));
  float noise = fract(52.982918 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))) * 6.2831853;
  vec2 r = vec2(cos(noise), sin(noise));
  float blockers = 0.0, height = 0.0;
  for (int k = 0; k < 16; k++) {
    float a = float(k) * 2.3999632, d = sqrt((float(k) + 0.5) / 16.0) * 0.06;
    vec2 o = d * vec2(cos(a) * r.x - sin(a) * r.y, sin(a) * r.x + cos(a) * r.y);
    float other = 1.0 - 2.0 * texture(shadow, 0.5 + 0.5 * (mine.xy + o)).r;
    if (other > mine.z + 0.5 * d + 0.004) { blockers += 1.0; height += other - mine.z; }
  }
  if (blockers == 0.0) return 1.0;
  float spread = clamp(0.08 * height / blockers, 0.003, 0.06);
  float blocked = 0.0;
  for (int k = 0; k < 16; k++) {
    float a = float(k) * 2.3999632, d = sqrt((float(k) + 0.5) / 16.0) * spread;
    vec2 o = d * vec2(cos(a) * r.x - sin(a) * r.y, sin(a) * r.x + cos(a) * r.y);
    float other = 1.0 - 2.0 * texture(shadow, 0.5 + 0.5 * (mine.xy + o)).r;
    if (other > mine.z + 0.5 * d + 0.004) blocked += 1.0;
  }
  return 1.0 - blocked / 16.0;
}

/** Lifted onto the rounded surface that the normals describe, so that faces do not shade themselves. */
vec3 raised(float sign) {
  vec3 p = at;
  p -= sign * n0 * min(dot(at - c0, sign * n0), 0.0) * weights.x;
  p -= sign * n1 * min(dot(at - c1, sign * n1), 0.0) * weights.y;
  p -= sign * n2 * min(dot(at - c2, sign * n2), 0.0) * weights.z;
  return p;
}

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  if (layer >= 0) {
    if (gl_FragCoord.z >= texelFetch(opaque, here, 0).r) discard;
    if (layer > 0 && gl_FragCoord.z <= texelFetch(nearer, here, 0).r) discard;
  }
  color = vec4(0.0);
  if (depth_alone) return;
  int side = gl_FrontFacing ? 0 : 1;
  float sign = gl_FrontFacing ? 1.0 : -1.0;
  vec3 even = sign * normalize(cross(c1 - c0, c2 - c0));
  vec3 eye = perspective ? normalize(-at) : vec3(0.0, 0.0, 1.0);
  vec3 n = sign * normalize(normal);
  if (dot(n, even) < 0.0) n = even;
  float facing = dot(n, eye);
  if (facing < 0.0) n = normalize(n - eye * facing);
  vec3 albedo = painted_color(side);
  vec3 body = albedo, highlight = vec3(0.0);
  if (lit) {
    float share = casts ? light_seen(raised(sign), n) : 1.0;
    leaving(albedo, n, eye, 1.0 - occlusion * (1.0 - sky[side]), gloss, share, body, highlight);
  }
  float sheet = 1.0;
  if (layer >= 0) {
    float grazing = 1.0 - clamp(dot(n, eye), 0.0, 1.0);
    sheet = opacity[side] + (edge_opacity - opacity[side]) * grazing * grazing;
  }
  float cover = clamp(max(highlight.r, max(highlight.g, highlight.b)), 0.0, 1.0);
  float total = sheet + (1.0 - sheet) * cover;
  vec3 light = body * sheet + highlight;
  if (wireframe > 0.0) {
    vec3 rate = vec3(length(vec2(dFdx(weights.x), dFdy(weights.x))), length(vec2(dFdx(weights.y), dFdy(weights.y))), length(vec2(dFdx(weights.z), dFdy(weights.z))));
    vec3 away = weights.zxy / max(rate.zxy, 1e-9) / samples;     // pixels to the edges 01, 12, 20
    vec3 fade = clamp((lengths / samples - 3.0) / 3.0, 0.0, 1.0);
    vec3 cover3 = fade * clamp(1.0 - away, 0.0, 1.0);
    float wire = max(cover3.x, max(cover3.y, cover3.z)) * wireframe;
    light = line_color * wire + light * (1.0 - wire);
    total = wire + (1.0 - wire) * total;
  }
  color = vec4(light, total);
}`],

  // Segments with round ends, as wide as so many samples.
  lines: [`
${PROJECT}
in vec3 from, to;
uniform float radius, sink;      // in samples
uniform bool outline;
out vec2 offset;
flat out vec2 along;
flat out float stretch;
void main() {
  vec3 a = seen(from), b = seen(to);
  if (perspective && (a.z > -near || b.z > -near)) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vec4 pa = projected(a), pb = projected(b);
  vec2 qa = pa.xy / pa.w * 0.5 * size, qb = pb.xy / pb.w * 0.5 * size;
  float length_seen = length(qb - qa);
  along = length_seen > 1e-6 ? (qb - qa) / length_seen : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  float end = float(gl_VertexID % 2), edge = float(gl_VertexID / 2) * 2.0 - 1.0;
  vec2 place = mix(qa, qb, end) + radius * (along * (2.0 * end - 1.0) + across * edge);
  stretch = length_seen / radius;
  offset = vec2(end > 0.5 ? stretch + 1.0 : -1.0, edge);
  vec3 v = end > 0.5 ? b : a;
  float height = outline ? -(sink + 0.6 * length(b - a) / sample_size(a)) : radius;
  if (perspective) v *= 1.0 / (1.0 + 2.0 * half_height * height / size.y);
  else v.z += height * sample_size(v);
  vec4 p = projected(v);
  gl_Position = vec4(place / (0.5 * size), p.z / p.w, 1.0);
}`, `
${LIGHT}
uniform vec3 line_color;
uniform bool raised_line;
in vec2 offset;
flat in vec2 along;
flat in float stretch;
out vec4 color;
void main() {
  float over = offset.x < 0.0 ? offset.x : max(offset.x - stretch, 0.0);
  if (over * over + offset.y * offset.y > 1.0) discard;
  vec3 light = line_color;
  if (raised_line) {
    vec2 o = stretch > 0.01 ? vec2(-along.y, along.x) * offset.y : vec2(over, offset.y);
    vec3 n = normalize(vec3(o, sqrt(max(1.0 - dot(o, o), 0.0))));
    vec3 body, highlight;
    leaving(line_color, n, vec3(0.0, 0.0, 1.0), 1.0, 1.0, 1.0, body, highlight);
    light = body + highlight;
  }
  color = vec4(light, 1.0);
}`],

  // What the key light sees.
  shadow: [`
${FETCH}
uniform mat3 turn;
uniform vec3 shift, shadow_x, shadow_y, shadow_z, shadow_middle;
uniform float shadow_radius;
void main() {
  uvec4 corners = entry(faces, uint(gl_VertexID / 3));
  vec3 v = (turn * entry(places, corners[gl_VertexID % 3]).xyz + shift - shadow_middle) / shadow_radius;
  gl_Position = vec4(dot(v, shadow_x), dot(v, shadow_y), -dot(v, shadow_z), 1.0);
}`, `void main() {}`],

  // A layer over or under others.
  layer: [`
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`, `
uniform highp sampler2D picture;
out vec4 color;
void main() { color = texelFetch(picture, ivec2(gl_FragCoord.xy), 0); }`],

  // From samples to pixels: tone curve, filter, background, sRGB.
  pixels: [`
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`, `
uniform highp sampler2D picture;
uniform vec2 scale, size;        // samples per pixel; size of the picture in pixels
uniform vec3 background[2];
uniform bool lit;
out vec4 color;
vec3 curve(vec3 x) { return mix(x, 1.0 - 0.2 * exp(-(x - 0.8) / 0.2), step(0.8, x)); }
vec4 toned(vec4 light) {
  if (light.a <= 0.0 || !lit) return light;
  return vec4(curve(light.rgb / light.a) * light.a, light.a);
}
float blackman_harris(float x) {
  float t = 3.14159265 * clamp(x + 0.5, 0.0, 1.0) * 2.0;
  return 0.35875 - 0.48829 * cos(t) + 0.14128 * cos(2.0 * t) - 0.01168 * cos(3.0 * t);
}
void main() {
  vec2 middle = gl_FragCoord.xy * scale;
  ivec2 limit = textureSize(picture, 0) - 1;
  ivec2 low = ivec2(floor(middle - FILTER * scale)), high = ivec2(ceil(middle + FILTER * scale));
  vec4 sum = vec4(0.0);
  float weight = 0.0;
  for (int y = low.y; y < high.y; y++)
    for (int x = low.x; x < high.x; x++) {
      vec2 away = (vec2(x, y) + 0.5 - middle) / scale;
      float w = blackman_harris(away.x / (2.0 * FILTER)) * blackman_harris(away.y / (2.0 * FILTER));
      sum += w * toned(texelFetch(picture, clamp(ivec2(x, y), ivec2(0), limit), 0));
      weight += w;
    }
  sum /= weight;
  vec3 linear = sum.rgb + (1.0 - sum.a) * mix(background[1], background[0], gl_FragCoord.y / size.y);
  linear = clamp(linear, 0.0, 1.0);
  vec3 srgb = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
  color = vec4(srgb, 1.0);
}`],
};
