// SPDX-License-Identifier: BSD-3-Clause
#include "gl_api.hpp"

#include <array>
#include <string>

namespace hypermap {
namespace {

Result<GLuint> compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::array<char, 1024> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return fail(ErrorCode::kUnavailable, std::string("OpenGL refuses a shader: ") + log.data());
}

}  // namespace

Result<GLuint> make_program(const char* vertex_source, const char* fragment_source) {
  HYPERMAP_ASSIGN_OR_RETURN(const GLuint vertex, compile(GL_VERTEX_SHADER, vertex_source));
  HYPERMAP_ASSIGN_OR_RETURN(const GLuint fragment, compile(GL_FRAGMENT_SHADER, fragment_source));
  const GLuint program = glCreateProgram();
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  std::array<char, 1024> log{};
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return fail(ErrorCode::kUnavailable, std::string("OpenGL refuses a program: ") + log.data());
}

Result<void> check_gl(const char* during) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return {};
  const std::string what = "OpenGL error " + std::to_string(error) + " while " + during;
  return fail(error == GL_OUT_OF_MEMORY ? ErrorCode::kOutOfMemory : ErrorCode::kUnavailable, what);
}

}  // namespace hypermap
