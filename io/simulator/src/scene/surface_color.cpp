// SPDX-License-Identifier: BSD-3-Clause
#include "surface_color.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace hypermap {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Position on the surface: the two coordinates across the normal's largest component.
Vector2f along_surface(const Vector3f& p, const Vector3f& n) {
  const Vector3f a = n.cwiseAbs();
  if (a.z() >= a.x() && a.z() >= a.y()) return {p.x(), p.y()};
  return a.x() >= a.y() ? Vector2f(p.y(), p.z()) : Vector2f(p.x(), p.z());
}

/// A number in 0 .. 1 that belongs to a cell of a grid.
float cell_noise(float x, float y, std::uint64_t salt) {
  const auto cell = [](float value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value)));
  };
  const std::uint64_t bits = mix_bits((cell(x) << 32U) ^ (cell(y) & 0xFFFFFFFFU) ^ (salt << 56U));
  return static_cast<float>(bits >> 40U) * 0x1.0p-24F;
}

/// Noise that is smooth between cells of edge 1.
float smooth_noise(float x, float y, std::uint64_t salt) {
  const float u = x - std::floor(x);
  const float v = y - std::floor(y);
  const float low = std::lerp(cell_noise(x, y, salt), cell_noise(x + 1.0F, y, salt), u);
  const float high =
      std::lerp(cell_noise(x, y + 1.0F, salt), cell_noise(x + 1.0F, y + 1.0F, salt), u);
  return std::lerp(low, high, v);
}

float fraction(float x) {
  return x - std::floor(x);
}

float wood(const Vector2f& at) {
  const float streak = smooth_noise(at.x() * 60.0F, at.y() * 3.0F, 11);
  const float ring =
      fraction(at.x() * 9.0F + 0.8F * smooth_noise(at.x() * 2.0F, at.y() * 1.5F, 12));
  return 0.8F + 0.14F * streak + 0.1F * ring;
}

float tiles(const Vector2f& at) {
  constexpr float kTileM = 0.5F;
  constexpr float kJoint = 0.012F;
  const Vector2f tile = at / kTileM;
  if (fraction(tile.x()) < kJoint || fraction(tile.y()) < kJoint) return 0.62F;
  return 0.92F + 0.06F * cell_noise(tile.x(), tile.y(), 21) +
         0.04F * smooth_noise(at.x() * 40.0F, at.y() * 40.0F, 22);
}

float brick(const Vector2f& at) {
  const float row = std::floor(at.y() / 0.08F);
  const float along = at.x() / 0.25F + fraction(0.5F * row);
  if (fraction(at.y() / 0.08F) < 0.1F || fraction(along) < 0.04F) return 1.1F;
  return 0.85F + 0.2F * cell_noise(along, row, 31);
}

float keys(const Vector2f& at) {
  const Vector2f key = at / 0.019F;
  return fraction(key.x()) < 0.18F || fraction(key.y()) < 0.18F ? 0.25F : 1.0F;
}

/// A desktop: a gradient with two pale windows that have a dark bar on top.
Vector3f screen(const Vector3f& base, const Vector2f& at) {
  constexpr std::array<std::array<float, 4>, 2> kWindows{
      {{-0.20F, 0.18F, -0.02F, 0.36F}, {0.02F, 0.16F, 0.19F, 0.30F}}};
  for (const auto& [left, bottom, right, top] : kWindows) {
    if (at.x() < left || at.x() > right || at.y() < bottom || at.y() > top) continue;
    if (at.y() > top - 0.02F) return {0.2F, 0.25F, 0.35F};
    const bool text =
        fraction(at.y() / 0.016F) < 0.4F && cell_noise(at.x() / 0.03F, at.y() / 0.016F, 41) < 0.75F;
    return text ? Vector3f(0.35F, 0.36F, 0.4F) : Vector3f(0.95F, 0.95F, 0.92F);
  }
  return base * (0.75F + 0.7F * at.y());
}

Vector3f notes(const Vector3f& base, const Vector2f& at) {
  const float line = fraction(at.y() / 0.09F);
  const float length = cell_noise(std::floor(at.x() / 0.45F), at.y() / 0.09F, 51);
  const bool written = line > 0.35F && line < 0.55F &&
                       fraction(at.x() / 0.45F) < 0.25F + 0.6F * length &&
                       smooth_noise(at.x() * 90.0F, at.y() * 20.0F, 52) > 0.3F && length > 0.3F;
  if (!written) return base;
  return length > 0.75F ? Vector3f(0.75F, 0.15F, 0.15F) : Vector3f(0.12F, 0.2F, 0.55F);
}

}  // namespace

Vector3f surface_color(const SurfaceMaterial& material,
                       const Vector3f& point,
                       const Vector3f& normal) {
  Vector3f base = Vector3f(material.color.r, material.color.g, material.color.b) / 255.0F;
  const Vector2f at = along_surface(point, normal);
  switch (material.pattern) {
    case SurfacePattern::kPlain:
      return base * (0.98F + 0.04F * smooth_noise(at.x() * 25.0F, at.y() * 25.0F, 1));
    case SurfacePattern::kWood:
      return base * wood(at);
    case SurfacePattern::kTiles:
      return base * tiles(at);
    case SurfacePattern::kFabric:
      return base * (0.88F + 0.24F * smooth_noise(at.x() * 180.0F, at.y() * 180.0F, 61));
    case SurfacePattern::kKeys:
      return base * keys(at);
    case SurfacePattern::kScreen:
      return screen(base, at);
    case SurfacePattern::kNotes:
      return notes(base, at);
    case SurfacePattern::kBrick:
      return base * brick(at);
  }
  return base;
}

}  // namespace hypermap
