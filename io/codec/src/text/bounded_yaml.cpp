// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/bounded_yaml.hpp"

#include "flat_records.hpp"
#include "hypermap/core/base/utf8.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "yaml_tree_builder.hpp"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <exception>
#include <istream>
#include <new>
#include <streambuf>

namespace hypermap {
namespace {

int line_of(std::string_view bytes, std::size_t at) {
  return 1 +
         static_cast<int>(std::count(bytes.begin(), bytes.begin() + static_cast<long>(at), '\n'));
}

Error malformed(std::string what, int line) {
  return {.code = ErrorCode::kMalformedFile, .what = std::move(what), .line = line};
}

/// Bytes that YAML does not allow; yaml-cpp takes some of them for the end of the file.
std::optional<std::string> forbidden(std::string_view bytes, std::size_t at) {
  const auto byte = static_cast<unsigned char>(bytes[at]);
  if (byte == '\r') {
    const bool is_crlf = at + 1 < bytes.size() && bytes[at + 1] == '\n';
    return is_crlf ? std::nullopt : std::optional<std::string>("carriage return without line feed");
  }
  const bool is_control = (byte < 0x20 && byte != '\t' && byte != '\n') || byte == 0x7F;
  if (!is_control) return std::nullopt;
  return "control character " + printable(bytes.substr(at, 1)) + ", expected text";
}

Result<void> check_encoding(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    return tl::make_unexpected(malformed("is UTF-16 or UTF-32, expected UTF-8", 1));
  }
  if (const std::size_t bad = first_bad_utf8(bytes); bad < bytes.size()) {
    return tl::make_unexpected(
        malformed("byte " + printable(bytes.substr(bad, 1)) + " is no UTF-8", line_of(bytes, bad)));
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    if (const auto what = forbidden(bytes, at)) {
      return tl::make_unexpected(malformed(*what, line_of(bytes, at)));
    }
  }
  return {};
}

/// Hands the bytes out in small portions and counts what opens or separates flow items, because
/// yaml-cpp keeps all tokens of a flow collection until it is closed.
class CountingBuffer : public std::streambuf {
 public:
  CountingBuffer(std::string_view bytes, YamlTreeBuilder& builder)
      : bytes_(bytes), builder_(builder) {}

 protected:
  std::streamsize xsgetn(char* target, std::streamsize wanted) override {
    const std::size_t count = std::min(static_cast<std::size_t>(wanted), bytes_.size() - next_);
    const std::string_view portion = bytes_.substr(next_, count);
    std::copy(portion.begin(), portion.end(), target);
    next_ += count;
    builder_.count_flow_items(num_flow_marks(portion));
    return static_cast<std::streamsize>(count);
  }
  int_type underflow() override {
    return next_ < bytes_.size() ? traits_type::to_int_type(bytes_[next_]) : traits_type::eof();
  }
  int_type uflow() override {
    return next_ < bytes_.size() ? traits_type::to_int_type(bytes_[next_++]) : traits_type::eof();
  }

  /// The parser looks at the first bytes for a mark of their encoding and puts them back.
  int_type pbackfail(int_type /*byte*/) override {
    return next_ > 0 ? traits_type::to_int_type(bytes_[--next_]) : traits_type::eof();
  }

 private:
  std::string_view bytes_;
  YamlTreeBuilder& builder_;
  std::size_t next_ = 0;
};

Result<ValueTree> parse_tree(std::string_view bytes, const YamlLimits& limits) {
  try {
    YamlTreeBuilder builder(limits);
    CountingBuffer buffer(bytes, builder);
    std::istream stream(&buffer);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
    return builder.take();
  } catch (const YamlRefusal& refusal) {
    return tl::make_unexpected(refusal.error);
  } catch (const YAML::DeepRecursion& deep) {
    return tl::make_unexpected(
        Error{.code = ErrorCode::kLimit,
              .what = "nested deeper than " + std::to_string(limits.max_depth) + " levels",
              .line = deep.mark.line + 1});
  } catch (const YAML::Exception& exception) {
    const bool is_star = exception.msg == YAML::ErrorMsg::UNKNOWN_ANCHOR;
    const std::string what =
        is_star ? "nothing is called by the * here; text that begins with * stands in quotes"
                : "is no YAML: " + exception.msg;
    return tl::make_unexpected(malformed(what, exception.mark.line + 1));
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "no memory for the document");
  } catch (const std::exception& exception) {
    return tl::make_unexpected(malformed(std::string("is no YAML: ") + exception.what(), 0));
  }
}

}  // namespace

Result<YamlDocument> parse_yaml(std::string_view bytes,
                                const SourceName& source,
                                const YamlLimits& limits) {
  const auto refuse = [&](Error error) {
    return tl::make_unexpected(with_source(std::move(error), source));
  };
  if (bytes.size() > limits.max_bytes) {
    return refuse({.code = ErrorCode::kLimit,
                   .what = "has " + std::to_string(bytes.size()) +
                           " bytes, the limit for YAML is " + std::to_string(limits.max_bytes)});
  }
  if (auto checked = check_encoding(bytes); !checked) return refuse(checked.error());
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (auto records = flat_records(bytes, limits)) return YamlDocument{source, *std::move(records)};
  auto tree = parse_tree(bytes, limits);
  if (!tree) return refuse(tree.error());
  return YamlDocument{source, std::move(*tree)};
}

Result<YamlDocument> read_yaml(const std::filesystem::path& path, const YamlLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes, read_file(path, limits.max_bytes));
  return parse_yaml(bytes, {.file = path.string()}, limits);
}

}  // namespace hypermap
