// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Shared ownership of a value that is copied by whoever writes to it while others own it too.
#pragma once

#include <atomic>
#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>

namespace hypermap {

/// How many references own the value that this is the member `owners` of. A copy of the value has
/// owners of its own.
class OwnerCount {
 public:
  OwnerCount() noexcept = default;
  OwnerCount(const OwnerCount& /*other*/) noexcept {}
  OwnerCount& operator=(const OwnerCount& /*other*/) noexcept { return *this; }
  OwnerCount(OwnerCount&&) = delete;
  OwnerCount& operator=(OwnerCount&&) = delete;
  ~OwnerCount() = default;

 private:
  template <class T>
  friend class CowRef;
  std::atomic<std::uint32_t> num_{0};
};

/// A reference to a shared T, or null. Copies are one atomic increment and never fail; `writable`
/// gives the only owner the value itself and everyone else a copy.
///
/// Requires: T has a member `OwnerCount owners`. A T with `static void dispose(T*) noexcept` is
/// given up by that, any other is deleted.
/// Threads: as std::shared_ptr. A value owned twice is never written, so owners in other threads
/// may read theirs without a lock.
template <class T>
class CowRef {
 public:
  CowRef() noexcept = default;  ///< Null.
  explicit CowRef(std::unique_ptr<T> value) noexcept : value_(value.release()) { retain(); }
  template <class... Args>
  [[nodiscard]] static CowRef make(Args&&... args) {
    return CowRef(std::make_unique<T>(std::forward<Args>(args)...));
  }
  CowRef(const CowRef& other) noexcept : value_(other.value_) { retain(); }
  CowRef(CowRef&& other) noexcept : value_(std::exchange(other.value_, nullptr)) {}
  CowRef& operator=(CowRef other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~CowRef() { release(); }

  [[nodiscard]] explicit operator bool() const noexcept { return value_ != nullptr; }
  [[nodiscard]] const T& operator*() const noexcept { return *value_; }
  [[nodiscard]] const T* operator->() const noexcept { return value_; }
  /// Whether both own one value.
  [[nodiscard]] bool shares(const CowRef& other) const noexcept { return value_ == other.value_; }
  /// Whether nobody else owns the value. Acquire: who gave it up last has finished reading it.
  /// Requires, here and below: not null.
  [[nodiscard]] bool is_sole() const noexcept {
    return value_->owners.num_.load(std::memory_order_acquire) == 1;
  }

  /// The value, to write to; when others own it too, a copy takes its place first. Throws what
  /// copying throws, and nothing has changed then.
  [[nodiscard]] T& writable() {
    if (!is_sole()) *this = make(*value_);
    return *value_;
  }
  /// The value, to write to. Requires: is_sole().
  [[nodiscard]] T& sole() noexcept {
    assert(is_sole());
    return *value_;
  }

 private:
  void retain() noexcept {
    if (value_ != nullptr) value_->owners.num_.fetch_add(1, std::memory_order_relaxed);
  }
  // The analyzer does not follow counts: to it any owner may be the last one, after another was.
  // NOLINTBEGIN(clang-analyzer-cplusplus.NewDelete)
  void release() noexcept {
    if (value_ == nullptr) return;
    if (value_->owners.num_.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    if constexpr (requires(T * last) { T::dispose(last); }) {
      T::dispose(value_);
    } else {
      const std::unique_ptr<T> last(value_);
    }
  }
  // NOLINTEND(clang-analyzer-cplusplus.NewDelete)

  T* value_ = nullptr;
};

}  // namespace hypermap
