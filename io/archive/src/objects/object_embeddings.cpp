// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/object_embeddings.hpp"

#include "hypermap/io/codec/number_bytes.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kEmbeddingsSignature = "HMEMBED1";
constexpr std::size_t kNumberBytes = 4;

std::uint32_t as_uint32(std::size_t value) {
  return static_cast<std::uint32_t>(value);
}

/// A table of the file: who has embeddings of the model.
struct ModelTable {
  std::string model;
  std::uint32_t dimension = 0;
  std::vector<ObjectId> ids;
  std::vector<std::uint32_t> counts;
};

/// Reads on from one place to the next; errors name the place.
class EmbeddingsReader {
 public:
  EmbeddingsReader(std::string_view bytes, const SourceName& source)
      : bytes_(bytes), source_(source) {}

  Result<ObjectEmbeddings> read() {
    if (!bytes_.starts_with(kEmbeddingsSignature)) return error("is no file of embeddings");
    at_ = kEmbeddingsSignature.size();
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint32_t num_models, number());
    if (num_models > kMaxMapModels) {
      return error("at most " + std::to_string(kMaxMapModels) + " models are read, says " +
                       std::to_string(num_models),
                   ErrorCode::kLimit);
    }
    for (std::uint32_t i = 0; i < num_models; ++i) HYPERMAP_TRY(read_model());
    if (at_ < bytes_.size()) {
      return error("must end here, has " + std::to_string(bytes_.size() - at_) + " bytes more");
    }
    return restored();
  }

 private:
  [[nodiscard]] Unexpected error(std::string what,
                                 ErrorCode code = ErrorCode::kMalformedFile) const {
    Error failed{.code = code, .what = std::move(what), .field = "byte " + std::to_string(at_)};
    return tl::make_unexpected(with_source(std::move(failed), source_));
  }

  Result<std::string_view> take(std::uint64_t num_bytes) {
    if (num_bytes > bytes_.size() - at_) {
      return error("is cut, expected " + std::to_string(num_bytes) + " bytes, has " +
                   std::to_string(bytes_.size() - at_));
    }
    const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(num_bytes));
    at_ += taken.size();
    return taken;
  }

  Result<std::uint32_t> number() {
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view taken, take(kNumberBytes));
    return uint32_at(taken, 0);
  }

  Result<void> read_model() {
    ModelTable table;
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint32_t num_name_bytes, number());
    HYPERMAP_ASSIGN_OR_RETURN(table.model, take(num_name_bytes));
    if (table.model <= newest_model_) return error("names of models must ascend");
    newest_model_ = table.model;
    HYPERMAP_ASSIGN_OR_RETURN(table.dimension, number());
    if (table.dimension == 0 || table.dimension > kMaxEmbeddingDimension) {
      return error("dimension must be in 1 .. " + std::to_string(kMaxEmbeddingDimension) + ", is " +
                   std::to_string(table.dimension));
    }
    HYPERMAP_TRY(read_ids(table));
    return read_means(table);
  }

  Result<void> read_ids(ModelTable& table) {
    HYPERMAP_ASSIGN_OR_RETURN(const std::uint32_t num_objects, number());
    HYPERMAP_ASSIGN_OR_RETURN(const std::string_view pairs,
                              take(std::uint64_t{2 * kNumberBytes} * num_objects));
    table.ids.reserve(num_objects);
    table.counts.reserve(num_objects);
    ObjectId newest = kNoObject;
    for (std::size_t at = 0; at < pairs.size(); at += 2 * kNumberBytes) {
      const ObjectId id{uint32_at(pairs, at)};
      if (!(newest < id)) return error("ids of objects must ascend from 1 on");
      newest = id;
      table.ids.push_back(id);
      table.counts.push_back(uint32_at(pairs, at + kNumberBytes));
    }
    return {};
  }

  Result<void> read_means(const ModelTable& table) {
    for (std::size_t i = 0; i < table.ids.size(); ++i) {
      const std::size_t begin = at_;
      HYPERMAP_ASSIGN_OR_RETURN(const std::string_view taken,
                                take(std::uint64_t{kNumberBytes} * table.dimension));
      HYPERMAP_ASSIGN_OR_RETURN(std::vector<float> mean, floats_of_bytes(taken));
      MeanEmbedding entry{.model = table.model, .count = table.counts[i], .mean = std::move(mean)};
      if (const auto valid = validate(entry); !valid) {
        at_ = begin;
        return error("of object " + std::to_string(table.ids[i].value) + ": " +
                     valid.error().field + " " + valid.error().what);
      }
      std::vector<MeanEmbedding>& of_object = entries_[table.ids[i]];
      if (of_object.size() >= kMaxEmbeddingModels) {
        return error("an object has at most " + std::to_string(kMaxEmbeddingModels) + " models, " +
                         std::to_string(table.ids[i].value) + " has more",
                     ErrorCode::kLimit);
      }
      of_object.push_back(std::move(entry));
    }
    return {};
  }

  Result<ObjectEmbeddings> restored() {
    ObjectEmbeddings embeddings;
    for (auto& [id, entries] : entries_) {
      HYPERMAP_ASSIGN_OR_RETURN(MeanEmbeddings means, MeanEmbeddings::restore(std::move(entries)));
      embeddings.emplace_hint(embeddings.end(), id, std::move(means));
    }
    return embeddings;
  }

  std::string_view bytes_;
  const SourceName& source_;
  std::size_t at_ = 0;
  std::string newest_model_;  // none has an empty name
  std::map<ObjectId, std::vector<MeanEmbedding>> entries_;
};

void append_model(std::string& bytes,
                  std::string_view model,
                  std::size_t dimension,
                  const ObjectEmbeddings& embeddings) {
  append_uint32(bytes, as_uint32(model.size()));
  bytes += model;
  append_uint32(bytes, as_uint32(dimension));
  std::string ids;
  std::string means;
  for (const auto& [id, of_object] : embeddings) {
    const MeanEmbedding* entry = of_object.find(model);
    if (entry == nullptr) continue;
    append_uint32(ids, id.value);
    append_uint32(ids, entry->count);
    means += bytes_of_floats(entry->mean);
  }
  append_uint32(bytes, as_uint32(ids.size() / (2 * kNumberBytes)));
  bytes += ids;
  bytes += means;
}

}  // namespace

ObjectEmbeddings embeddings_of(const ObjectMap& objects) {
  ObjectEmbeddings out;
  for (const Object& object : objects.objects()) {
    if (!object.embeddings.entries().empty()) {
      out.emplace_hint(out.end(), object.id, object.embeddings);
    }
  }
  return out;
}

Result<std::string> write_object_embeddings(const ObjectEmbeddings& embeddings) {
  EmbeddingDimensions dimensions;
  for (const auto& [id, of_object] : embeddings) {
    for (const MeanEmbedding& entry : of_object.entries()) {
      HYPERMAP_TRY(dimensions.add(entry.model, entry.mean.size()));
    }
  }
  std::string bytes(kEmbeddingsSignature);
  append_uint32(bytes, as_uint32(dimensions.models().size()));
  for (const auto& [model, dimension] : dimensions.models()) {
    append_model(bytes, model, dimension, embeddings);
  }
  return bytes;
}

Result<ObjectEmbeddings> parse_object_embeddings(std::string_view bytes, const SourceName& source) {
  return EmbeddingsReader(bytes, source).read();
}

std::size_t set_object_embeddings(ObjectMap& objects, const ObjectEmbeddings& embeddings) {
  std::size_t num_absent = 0;
  for (const auto& [id, means] : embeddings) {
    if (!objects.contains(id)) {
      ++num_absent;
      continue;
    }
    objects.modify(id, [&means = means](Object& object) { object.embeddings = means; });
  }
  return num_absent;
}

}  // namespace hypermap
