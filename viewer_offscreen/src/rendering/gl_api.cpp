// SPDX-License-Identifier: BSD-3-Clause
#include "gl_api.hpp"

#include <array>
#include <string>

namespace hypermap {
namespace {

Result<GLuint> compile(const GlApi& gl, GLenum kind, const char* source) {
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::array<char, 1024> log{};
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return fail(ErrorCode::kUnavailable, std::string("OpenGL refuses a shader: ") + log.data());
}

}  // namespace

Result<GlApi> load_gl(const EglContext& context) {
  GlApi gl;
#define HYPERMAP_GL_LOAD(type, name)                                           \
  gl.name = reinterpret_cast<PFNGL##type##PROC>(context.function("gl" #name)); \
  if (gl.name == nullptr) return fail(ErrorCode::kUnavailable, "OpenGL lacks gl" #name);
  HYPERMAP_GL_FUNCTIONS(HYPERMAP_GL_LOAD)
#undef HYPERMAP_GL_LOAD
  return gl;
}

Result<GLuint> make_program(const GlApi& gl,
                            const char* vertex_source,
                            const char* fragment_source) {
  HYPERMAP_ASSIGN_OR_RETURN(const GLuint vertex, compile(gl, GL_VERTEX_SHADER, vertex_source));
  HYPERMAP_ASSIGN_OR_RETURN(const GLuint fragment,
                            compile(gl, GL_FRAGMENT_SHADER, fragment_source));
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, vertex);
  gl.AttachShader(program, fragment);
  gl.LinkProgram(program);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::array<char, 1024> log{};
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return fail(ErrorCode::kUnavailable, std::string("OpenGL refuses a program: ") + log.data());
}

Result<void> check_gl(const GlApi& gl, const char* during) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR) return {};
  const std::string what = "OpenGL error " + std::to_string(error) + " while " + during;
  return fail(error == GL_OUT_OF_MEMORY ? ErrorCode::kOutOfMemory : ErrorCode::kUnavailable, what);
}

}  // namespace hypermap
