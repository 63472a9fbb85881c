// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the objects of a map look to image networks, as bytes beside their lines of JSON, so that
/// what is read equals what was written bit by bit.
///
/// "HMEMBED1", the number of models, then for each, in ascending order of the names: bytes of its
/// name, the name, dimension, number of objects; for each of these, in ascending order, its id and
/// its count; then their means, floats of 32 bits. All numbers before are of 32 bits, unsigned; all
/// little endian.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/io/codec/source_name.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace hypermap {

/// By the object that has them; none is empty.
using ObjectEmbeddings = std::map<ObjectId, MeanEmbeddings>;

/// Those of all objects that have any. Cost: a copy of them.
[[nodiscard]] ObjectEmbeddings embeddings_of(const ObjectMap& objects);

/// Errors: those of EmbeddingDimensions::add, of objects that differ in the dimension of a model.
[[nodiscard]] Result<std::string> write_object_embeddings(const ObjectEmbeddings& embeddings);

/// Errors: kMalformedFile naming the byte as the field ("byte 24"): no such file, cut, longer than
/// it says, names or ids that do not ascend, whatever `validate(MeanEmbedding)` refuses; kLimit for
/// more than kMaxMapModels models, or kMaxEmbeddingModels of an object. What a number says is
/// compared with what is left before memory is taken.
[[nodiscard]] Result<ObjectEmbeddings> parse_object_embeddings(std::string_view bytes,
                                                               const SourceName& source);

/// Gives the objects their embeddings, in place of those that they have. Returns of how many ids
/// there is no object: theirs are left out.
[[nodiscard]] std::size_t set_object_embeddings(ObjectMap& objects,
                                                const ObjectEmbeddings& embeddings);

}  // namespace hypermap
