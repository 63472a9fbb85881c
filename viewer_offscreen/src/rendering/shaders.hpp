// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The programs that run per vertex and per pixel (GLSL 3.30).
#pragma once

namespace hypermap {

/// One triangle over the whole image, shaded from top to bottom.
inline constexpr const char* kBackdropVertex = R"(#version 330 core
out float height;
void main() {
  vec2 p = vec2((gl_VertexID == 1) ? 3.0 : -1.0, (gl_VertexID == 2) ? 3.0 : -1.0);
  height = 0.5 * (p.y + 1.0);
  gl_Position = vec4(p, 1.0, 1.0);
})";
inline constexpr const char* kBackdropFragment = R"(#version 330 core
uniform vec3 upper;
uniform vec3 lower;
in float height;
out vec4 color;
void main() { color = vec4(mix(lower, upper, height), 1.0); })";

/// A quad from four corners, textured with the colours of the cells.
inline constexpr const char* kGridVertex = R"(#version 330 core
layout(location = 0) in vec3 corner;
uniform mat4 clip_from_map;
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = clip_from_map * vec4(corner, 1.0);
})";
inline constexpr const char* kGridFragment = R"(#version 330 core
uniform sampler2D cells;
in vec2 place;
out vec4 color;
void main() { color = texture(cells, place); })";

inline constexpr const char* kFlatVertex = R"(#version 330 core
layout(location = 0) in vec3 point;
uniform mat4 clip_from_map;
void main() { gl_Position = clip_from_map * vec4(point, 1.0); })";
inline constexpr const char* kFlatFragment = R"(#version 330 core
uniform vec4 paint;
out vec4 color;
void main() { color = paint; })";

/// One instance per voxel face. Light: each direction its own shade, so that edges show; corners in
/// nooks are darker; a thin seam between voxels where they are large enough to be distinguished.
inline constexpr const char* kFaceVertex = R"(#version 330 core
layout(location = 0) in vec4 centre_edge;
layout(location = 1) in vec4 paint;
layout(location = 2) in vec4 openness;
layout(location = 3) in uint direction;
uniform mat4 clip_from_map;
uniform vec3 fog_from;     // eye in the map
uniform float fog_length;  // 0: none
flat out vec3 base;
flat out vec4 open;
out vec2 place;
out float fog;
const vec3 kNormal[6] = vec3[6](vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0),
                                vec3(0, 0, 1), vec3(0, 0, -1));
const vec3 kFirst[6] = vec3[6](vec3(0, 1, 0), vec3(0, 0, 1), vec3(0, 0, 1), vec3(1, 0, 0),
                               vec3(1, 0, 0), vec3(0, 1, 0));
const vec3 kSecond[6] = vec3[6](vec3(0, 0, 1), vec3(0, 1, 0), vec3(1, 0, 0), vec3(0, 0, 1),
                                vec3(0, 1, 0), vec3(1, 0, 0));
const float kShade[6] = float[6](0.80, 0.86, 0.74, 0.92, 1.0, 0.62);
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 offset = place - 0.5;
  uint d = direction;
  vec3 point = centre_edge.xyz + centre_edge.w *
      (0.5 * kNormal[d] + offset.x * kFirst[d] + offset.y * kSecond[d]);
  base = paint.rgb * kShade[d];
  open = openness;
  float far = length(point - fog_from) / max(fog_length, 1e-6);
  fog = fog_length > 0.0 ? 1.0 - exp(-far * far) : 0.0;
  gl_Position = clip_from_map * vec4(point, 1.0);
})";
inline constexpr const char* kFaceFragment = R"(#version 330 core
uniform vec3 fog_color;
flat in vec3 base;
flat in vec4 open;
in vec2 place;
in float fog;
out vec4 color;
void main() {
  float openness = mix(mix(open.x, open.y, place.x), mix(open.z, open.w, place.x), place.y);
  float light = mix(0.60, 1.0, openness / 3.0);
  vec2 step = fwidth(place);
  vec2 to_seam = min(place, 1.0 - place) / max(step, vec2(1e-6));
  float seam = 1.0 - smoothstep(0.0, 1.0, min(to_seam.x, to_seam.y));
  float large = smoothstep(5.0, 16.0, 1.0 / max(max(step.x, step.y), 1e-6));
  vec3 lit = base * light * (1.0 - 0.14 * seam * large);
  color = vec4(mix(lit, fog_color, 0.55 * fog), 1.0);
})";

/// One instance per line: a quad in the image's plane, soft at its sides. What lies behind the
/// eye is cut off first.
inline constexpr const char* kLineVertex = R"(#version 330 core
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 paint;
uniform mat4 clip_from_map;
uniform vec2 half_image_px;
uniform float half_width_px;
out float across_px;
flat out vec4 line_paint;
const float kNear = 0.05;
void main() {
  vec4 a = clip_from_map * vec4(from, 1.0);
  vec4 b = clip_from_map * vec4(to, 1.0);
  line_paint = paint;
  across_px = 0.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside, when the whole line is behind the eye
  if (a.w < kNear && b.w < kNear) return;
  if (a.w < kNear) a = mix(b, a, (b.w - kNear) / (b.w - a.w));
  if (b.w < kNear) b = mix(a, b, (a.w - kNear) / (a.w - b.w));
  vec2 a_px = a.xy / a.w * half_image_px;
  vec2 b_px = b.xy / b.w * half_image_px;
  vec2 along = b_px - a_px;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  float reach = half_width_px + 1.0;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  bool at_end = (gl_VertexID >> 1) == 1;
  vec4 end = at_end ? b : a;
  vec2 offset = side * reach * vec2(-along.y, along.x) + (at_end ? 0.5 : -0.5) * half_width_px * along;
  across_px = side * reach;
  end.xy += offset / half_image_px * end.w;
  end.z -= 0.0015 * end.w;
  gl_Position = end;
})";
inline constexpr const char* kLineFragment = R"(#version 330 core
uniform float half_width_px;
in float across_px;
flat in vec4 line_paint;
out vec4 color;
void main() {
  float cover = clamp(half_width_px + 0.5 - abs(across_px), 0.0, 1.0);
  color = vec4(line_paint.rgb, line_paint.a * cover);
})";

}  // namespace hypermap
