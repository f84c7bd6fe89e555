#pragma once

#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace rung {

/// A position in one kind of Arena. Ids with different tags do not convert
/// into each other, so a CellId cannot be passed where a RungId is wanted.
/// Passed by value.
template <class Tag>
class Id {
 public:
  constexpr Id() = default;  // no value
  constexpr explicit Id(std::uint32_t index) : index_(index) {}

  constexpr bool has_value() const { return index_ != kNone; }
  constexpr std::uint32_t index() const {
    assert(has_value());
    return index_;
  }
  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffff;
  std::uint32_t index_ = kNone;
};

/// Owns values of T and hands out their ids, in order of insertion.
/// Iteration is in that order too, so every report is reproducible.
/// A reference into the arena lives until the next add().
template <class IdT, class T>
class Arena {
 public:
  IdT add(T value) {
    items_.push_back(std::move(value));
    return IdT(static_cast<std::uint32_t>(items_.size() - 1));
  }
  const T& operator[](IdT id) const {
    assert(id.index() < items_.size());
    return items_[id.index()];
  }
  T& operator[](IdT id) {
    assert(id.index() < items_.size());
    return items_[id.index()];
  }
  std::size_t size() const { return items_.size(); }
  bool empty() const { return items_.empty(); }
  void reserve(std::size_t count) { items_.reserve(count); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }

 private:
  // A vector and not a deque: a program of 100,000 rungs has a million nodes,
  // and every pass walks them in order.
  std::vector<T> items_;
};

/// The ids of an arena with `count` items, in order, for range-for.
template <class IdT>
class IdRange {
 public:
  class Iterator {
   public:
    explicit Iterator(std::uint32_t index) : index_(index) {}
    IdT operator*() const { return IdT(index_); }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator!=(const Iterator& other) const {
      return index_ != other.index_;
    }

   private:
    std::uint32_t index_;
  };

  explicit IdRange(std::size_t count)
      : count_(static_cast<std::uint32_t>(count)) {}
  Iterator begin() const { return Iterator(0); }
  Iterator end() const { return Iterator(count_); }

 private:
  std::uint32_t count_;
};

template <class IdT, class T>
IdRange<IdT> ids_of(const Arena<IdT, T>& arena) {
  return IdRange<IdT>(arena.size());
}

}  // namespace rung

template <class Tag>
struct std::hash<rung::Id<Tag>> {
  std::size_t operator()(rung::Id<Tag> id) const {
    return id.has_value() ? id.index() + 1U : 0U;
  }
};
