// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/class_palette.hpp"

#include <array>

namespace hypermap {
namespace {

// Found by a greedy search in Oklab: each colour is the one farthest from all before it, among
// those of medium lightness (0.44 .. 0.80) and chroma (0.09 .. 0.18); the first eight were chosen
// by hand.
constexpr std::array<Rgb8, kNumClassColors> kColors{
    {Rgb8{42, 113, 214},  Rgb8{229, 96, 34},   Rgb8{60, 158, 64},   Rgb8{235, 180, 50},
     Rgb8{125, 77, 190},  Rgb8{33, 172, 183},  Rgb8{215, 76, 130},  Rgb8{149, 92, 40},
     Rgb8{209, 169, 251}, Rgb8{17, 98, 67},    Rgb8{33, 223, 155},  Rgb8{134, 41, 96},
     Rgb8{253, 160, 163}, Rgb8{63, 79, 132},   Rgb8{140, 134, 195}, Rgb8{167, 142, 17},
     Rgb8{205, 108, 214}, Rgb8{179, 34, 43},   Rgb8{120, 199, 253}, Rgb8{152, 199, 47},
     Rgb8{18, 120, 141},  Rgb8{153, 95, 131},  Rgb8{100, 117, 32},  Rgb8{55, 159, 238},
     Rgb8{136, 186, 135}, Rgb8{200, 129, 144}, Rgb8{250, 120, 178}, Rgb8{172, 67, 165},
     Rgb8{160, 125, 251}, Rgb8{27, 70, 180},   Rgb8{88, 212, 208},  Rgb8{207, 146, 95},
     Rgb8{121, 34, 145},  Rgb8{13, 146, 120},  Rgb8{129, 58, 48},   Rgb8{253, 143, 244},
     Rgb8{190, 90, 86},   Rgb8{97, 82, 1},     Rgb8{149, 163, 252}, Rgb8{255, 133, 22},
     Rgb8{102, 132, 251}, Rgb8{5, 121, 24},    Rgb8{253, 106, 118}, Rgb8{112, 74, 123},
     Rgb8{89, 115, 170},  Rgb8{83, 53, 173},   Rgb8{114, 146, 88},  Rgb8{46, 191, 97},
     Rgb8{173, 62, 104},  Rgb8{195, 137, 200}, Rgb8{185, 173, 86},  Rgb8{35, 177, 137},
     Rgb8{190, 113, 37},  Rgb8{250, 168, 113}, Rgb8{140, 165, 7},   Rgb8{166, 107, 185},
     Rgb8{79, 88, 177},   Rgb8{63, 144, 185},  Rgb8{239, 161, 210}, Rgb8{107, 169, 212},
     Rgb8{114, 112, 205}, Rgb8{20, 104, 163},  Rgb8{170, 204, 116}, Rgb8{203, 102, 169},
     Rgb8{245, 136, 107}, Rgb8{176, 70, 19},   Rgb8{146, 123, 57},  Rgb8{56, 95, 4},
     Rgb8{204, 139, 243}, Rgb8{150, 23, 58},   Rgb8{138, 80, 156},  Rgb8{174, 185, 248},
     Rgb8{201, 197, 16},  Rgb8{153, 85, 88},   Rgb8{27, 187, 240},  Rgb8{162, 41, 127},
     Rgb8{161, 99, 218},  Rgb8{58, 123, 85},   Rgb8{217, 185, 121}, Rgb8{95, 61, 142},
     Rgb8{119, 212, 168}, Rgb8{116, 205, 116}, Rgb8{221, 76, 92},   Rgb8{218, 143, 11},
     Rgb8{201, 118, 95},  Rgb8{191, 101, 131}, Rgb8{114, 170, 95},  Rgb8{82, 134, 211},
     Rgb8{104, 139, 26},  Rgb8{6, 90, 124},    Rgb8{129, 68, 94},   Rgb8{125, 104, 162},
     Rgb8{20, 211, 247},  Rgb8{100, 190, 173}, Rgb8{229, 132, 207}, Rgb8{234, 137, 159}}};

}  // namespace

Rgb8 class_color(ClassId id) {
  return kColors[id.value % kColors.size()];
}

}  // namespace hypermap
