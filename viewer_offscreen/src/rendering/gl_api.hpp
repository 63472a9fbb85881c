// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The functions of OpenGL that pictures need, found at run time.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/viewer_offscreen/rendering/egl_context.hpp"

#include <GL/glcorearb.h>

namespace hypermap {

// One entry per function: the middle of its pointer type's name, and its own name without "gl".
#define HYPERMAP_GL_FUNCTIONS(X)                                    \
  X(ACTIVETEXTURE, ActiveTexture)                                   \
  X(ATTACHSHADER, AttachShader)                                     \
  X(BINDBUFFER, BindBuffer)                                         \
  X(BINDFRAMEBUFFER, BindFramebuffer)                               \
  X(BINDRENDERBUFFER, BindRenderbuffer)                             \
  X(BINDTEXTURE, BindTexture)                                       \
  X(BINDVERTEXARRAY, BindVertexArray)                               \
  X(BLENDFUNCSEPARATE, BlendFuncSeparate)                           \
  X(BLITFRAMEBUFFER, BlitFramebuffer)                               \
  X(BUFFERDATA, BufferData)                                         \
  X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                 \
  X(CLEAR, Clear)                                                   \
  X(CLEARCOLOR, ClearColor)                                         \
  X(COLORMASK, ColorMask)                                           \
  X(COMPILESHADER, CompileShader)                                   \
  X(CREATEPROGRAM, CreateProgram)                                   \
  X(CREATESHADER, CreateShader)                                     \
  X(DELETEBUFFERS, DeleteBuffers)                                   \
  X(DELETESHADER, DeleteShader)                                     \
  X(DEPTHFUNC, DepthFunc)                                           \
  X(DEPTHMASK, DepthMask)                                           \
  X(DISABLE, Disable)                                               \
  X(DRAWARRAYS, DrawArrays)                                         \
  X(DRAWARRAYSINSTANCED, DrawArraysInstanced)                       \
  X(ENABLE, Enable)                                                 \
  X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)               \
  X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)               \
  X(GENBUFFERS, GenBuffers)                                         \
  X(GENERATEMIPMAP, GenerateMipmap)                                 \
  X(GENFRAMEBUFFERS, GenFramebuffers)                               \
  X(GENRENDERBUFFERS, GenRenderbuffers)                             \
  X(GENTEXTURES, GenTextures)                                       \
  X(GENVERTEXARRAYS, GenVertexArrays)                               \
  X(GETERROR, GetError)                                             \
  X(GETINTEGERV, GetIntegerv)                                       \
  X(GETPROGRAMINFOLOG, GetProgramInfoLog)                           \
  X(GETPROGRAMIV, GetProgramiv)                                     \
  X(GETSHADERINFOLOG, GetShaderInfoLog)                             \
  X(GETSHADERIV, GetShaderiv)                                       \
  X(GETUNIFORMLOCATION, GetUniformLocation)                         \
  X(LINKPROGRAM, LinkProgram)                                       \
  X(PIXELSTOREI, PixelStorei)                                       \
  X(READPIXELS, ReadPixels)                                         \
  X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) \
  X(SHADERSOURCE, ShaderSource)                                     \
  X(STENCILFUNC, StencilFunc)                                       \
  X(STENCILOP, StencilOp)                                           \
  X(TEXIMAGE2D, TexImage2D)                                         \
  X(TEXPARAMETERI, TexParameteri)                                   \
  X(UNIFORM1F, Uniform1f)                                           \
  X(UNIFORM1I, Uniform1i)                                           \
  X(UNIFORM2F, Uniform2f)                                           \
  X(UNIFORM3F, Uniform3f)                                           \
  X(UNIFORM4F, Uniform4f)                                           \
  X(UNIFORMMATRIX4FV, UniformMatrix4fv)                             \
  X(USEPROGRAM, UseProgram)                                         \
  X(VERTEXATTRIBDIVISOR, VertexAttribDivisor)                       \
  X(VERTEXATTRIBIPOINTER, VertexAttribIPointer)                     \
  X(VERTEXATTRIBPOINTER, VertexAttribPointer)                       \
  X(VIEWPORT, Viewport)

/// OpenGL's functions under their own names: `gl.DrawArrays(...)`.
struct GlApi {
#define HYPERMAP_GL_MEMBER(type, name) PFNGL##type##PROC name = nullptr;
  HYPERMAP_GL_FUNCTIONS(HYPERMAP_GL_MEMBER)
#undef HYPERMAP_GL_MEMBER
};

/// Errors: kUnavailable naming the function that the driver lacks.
[[nodiscard]] Result<GlApi> load_gl(const EglContext& context);

/// Errors: kUnavailable with the driver's log, which names line and reason.
[[nodiscard]] Result<GLuint> make_program(const GlApi& gl,
                                          const char* vertex_source,
                                          const char* fragment_source);

/// Errors: kOutOfMemory or kUnavailable when OpenGL reports an error since the last call; `during`
/// says what was done.
[[nodiscard]] Result<void> check_gl(const GlApi& gl, const char* during);

}  // namespace hypermap
