// SPDX-License-Identifier: BSD-3-Clause
// The octomap tree type that carries labels: its registration and its bytes in a file.
#include "octree_semantic/support/octomap_trees.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>

namespace hypermap::test {
namespace {

constexpr std::size_t kLabelBytes = 20;

/// Little-endian, whatever the machine.
class ByteWriter {
 public:
  void put(std::uint32_t value, std::size_t num_bytes) {
    for (std::size_t i = 0; i < num_bytes; ++i) {
      bytes_[size_++] = static_cast<char>(static_cast<unsigned char>(value >> (8U * i)));
    }
  }
  [[nodiscard]] const std::array<char, kLabelBytes>& bytes() const { return bytes_; }

 private:
  std::array<char, kLabelBytes> bytes_{};
  std::size_t size_ = 0;
};

class ByteReader {
 public:
  explicit ByteReader(const std::array<char, kLabelBytes>& bytes) : bytes_(&bytes) {}
  std::uint32_t get(std::size_t num_bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < num_bytes; ++i) {
      const auto byte = static_cast<unsigned char>((*bytes_)[size_++]);
      value |= static_cast<std::uint32_t>(byte) << (8U * i);
    }
    return value;
  }

 private:
  const std::array<char, kLabelBytes>* bytes_;
  std::size_t size_ = 0;
};

std::uint32_t bits_of(MilliLogOdds value) {
  return static_cast<std::uint16_t>(value);
}
MilliLogOdds milli_of(std::uint32_t bits) {
  return static_cast<MilliLogOdds>(bits);
}

}  // namespace

std::ostream& SemanticOcTreeNode::writeData(std::ostream& stream) const {
  octomap::OcTreeNode::writeData(stream);
  ByteWriter writer;
  writer.put(label_.object.value, 4);
  writer.put(label_.object_votes, 2);
  writer.put(bits_of(label_.rest), 2);
  for (const ClassWeight& weight : label_.classes) {
    writer.put(weight.class_id, 2);
    writer.put(bits_of(weight.log_odds), 2);
  }
  return stream.write(writer.bytes().data(), kLabelBytes);
}

std::istream& SemanticOcTreeNode::readData(std::istream& stream) {
  octomap::OcTreeNode::readData(stream);
  std::array<char, kLabelBytes> bytes{};
  stream.read(bytes.data(), kLabelBytes);
  ByteReader reader(bytes);
  label_.object = ObjectId{reader.get(4)};
  label_.object_votes = static_cast<std::uint16_t>(reader.get(2));
  label_.rest = milli_of(reader.get(2));
  for (ClassWeight& weight : label_.classes) {
    weight.class_id = static_cast<std::uint16_t>(reader.get(2));
    weight.log_odds = milli_of(reader.get(2));
  }
  return stream;
}

const SemanticOcTree::Registration SemanticOcTree::kRegistration;

SemanticOcTree::SemanticOcTree(double resolution_m)
    : octomap::OccupancyOcTreeBase<SemanticOcTreeNode>(resolution_m) {
  kRegistration.ensure_linked();
}

SemanticOcTree::Registration::Registration() {
  // OctoMap's registry keeps the prototype for the life of the program.
  auto prototype = std::make_unique<SemanticOcTree>(0.1);
  prototype->clearKeyRays();
  octomap::AbstractOcTree::registerTreeType(prototype.release());
}

}  // namespace hypermap::test
