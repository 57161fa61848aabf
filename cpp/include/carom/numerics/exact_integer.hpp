// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstring>

namespace carom {

/// A signed integer on the stack, at most `Capacity` 64-bit limbs; no allocation, no rounding.
///
/// Predicates that a double cannot decide are decided here. Only the limbs in use are touched, so
/// a wide capacity costs memory and not time. Exceeding the capacity is a bug of the caller (its
/// degree count is wrong) and asserts.
template <int Capacity>
class ExactInteger {
 public:
  static constexpr int capacity = Capacity;

  ExactInteger() { limb_[0] = 0; }
  ExactInteger(std::int64_t value)  // NOLINT(google-explicit-constructor): integers are integers
      : sign_((value > 0) - (value < 0)), size_(value != 0) {
    limb_[0] =
        value < 0 ? ~static_cast<std::uint64_t>(value) + 1 : static_cast<std::uint64_t>(value);
  }
  ExactInteger(const ExactInteger& other) { *this = other; }
  ExactInteger& operator=(const ExactInteger& other) {
    sign_ = other.sign_;
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) limb_[i] = other.limb_[i];
    return *this;
  }

  [[nodiscard]] int sign() const { return sign_; }

  [[nodiscard]] int bit_length() const {
    return size_ == 0 ? 0 : 64 * size_ - std::countl_zero(limb_[size_ - 1]);
  }

  /// value = m 2^exponent with 2^63 <= |m| < 2^64 or m = 0; m truncated, so |error| < 2^-63 |m|.
  [[nodiscard]] double leading(int& exponent) const {
    exponent = 0;
    if (size_ == 0) return 0;
    const int zeros = std::countl_zero(limb_[size_ - 1]);
    std::uint64_t top = limb_[size_ - 1] << zeros;
    if (zeros > 0 && size_ > 1) top |= limb_[size_ - 2] >> (64 - zeros);
    exponent = 64 * (size_ - 1) - zeros;
    const double magnitude = static_cast<double>(top);
    return sign_ < 0 ? -magnitude : magnitude;
  }

  friend ExactInteger operator-(ExactInteger a) {
    a.sign_ = -a.sign_;
    return a;
  }
  friend ExactInteger operator+(const ExactInteger& a, const ExactInteger& b) {
    return sum(a, b, b.sign_);
  }
  friend ExactInteger operator-(const ExactInteger& a, const ExactInteger& b) {
    return sum(a, b, -b.sign_);
  }

  friend ExactInteger operator*(const ExactInteger& a, const ExactInteger& b) {
    ExactInteger r;
    r.sign_ = a.sign_ * b.sign_;
    r.size_ = 0;
    if (r.sign_ == 0) return r;
    const int n = a.size_, m = b.size_;
    assert(n + m <= Capacity + 1);
    std::uint64_t carry = 0;
    for (int i = 0; i < n; ++i) {
      const Wide p = static_cast<Wide>(a.limb_[i]) * b.limb_[0] + carry;
      r.limb_[i] = static_cast<std::uint64_t>(p);
      carry = static_cast<std::uint64_t>(p >> 64);
    }
    int size = n;
    if (carry != 0 || m > 1) r.limb_[size++] = carry;
    for (int j = 1; j < m; ++j) {
      carry = 0;
      for (int i = 0; i < n; ++i) {
        const Wide p = static_cast<Wide>(a.limb_[i]) * b.limb_[j] + r.limb_[i + j] + carry;
        r.limb_[i + j] = static_cast<std::uint64_t>(p);
        carry = static_cast<std::uint64_t>(p >> 64);
      }
      if (carry != 0 || j + 1 < m) r.limb_[size++] = carry;
    }
    assert(size <= Capacity);
    r.size_ = size;
    r.trim();
    return r;
  }

  /// value * 2^bits, bits >= 0
  [[nodiscard]] ExactInteger shifted(int bits) const {
    ExactInteger r;
    r.sign_ = sign_;
    r.size_ = 0;
    if (sign_ == 0) return r;
    const int limbs = bits / 64, rest = bits % 64;
    assert(size_ + limbs < Capacity);
    for (int i = 0; i < limbs; ++i) r.limb_[i] = 0;
    std::uint64_t carry = 0;
    for (int i = 0; i < size_; ++i) {
      r.limb_[i + limbs] = (limb_[i] << rest) | carry;
      carry = rest == 0 ? 0 : limb_[i] >> (64 - rest);
    }
    r.size_ = size_ + limbs;
    if (carry != 0) r.limb_[r.size_++] = carry;
    return r;
  }

 private:
  __extension__ using Wide = unsigned __int128;

  static int compare_magnitude(const ExactInteger& a, const ExactInteger& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
    for (int i = a.size_; i-- > 0;)
      if (a.limb_[i] != b.limb_[i]) return a.limb_[i] < b.limb_[i] ? -1 : 1;
    return 0;
  }

  // a + b, where b is read with the sign given
  static ExactInteger sum(const ExactInteger& a, const ExactInteger& b, int b_sign) {
    if (b_sign == 0) return a;
    if (a.sign_ == 0) {
      ExactInteger r = b;
      r.sign_ = b_sign;
      return r;
    }
    if (a.sign_ == b_sign) {
      ExactInteger r = a.size_ >= b.size_ ? added(a, b) : added(b, a);
      r.sign_ = b_sign;
      return r;
    }
    const int order = compare_magnitude(a, b);
    if (order == 0) return ExactInteger(0);
    ExactInteger r = order > 0 ? subtracted(a, b) : subtracted(b, a);
    r.sign_ = order > 0 ? a.sign_ : b_sign;
    return r;
  }

  static ExactInteger added(const ExactInteger& longer, const ExactInteger& shorter) {
    ExactInteger r;
    Wide carry = 0;
    int i = 0;
    for (; i < shorter.size_; ++i) {
      carry += static_cast<Wide>(longer.limb_[i]) + shorter.limb_[i];
      r.limb_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    for (; i < longer.size_; ++i) {
      carry += longer.limb_[i];
      r.limb_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    assert(i < Capacity || carry == 0);
    if (carry != 0) r.limb_[i++] = 1;
    r.size_ = i;
    return r;
  }

  static ExactInteger subtracted(const ExactInteger& larger, const ExactInteger& smaller) {
    ExactInteger r;
    std::uint64_t borrow = 0;
    int i = 0;
    for (; i < smaller.size_; ++i) {
      const Wide d = static_cast<Wide>(larger.limb_[i]) - smaller.limb_[i] - borrow;
      r.limb_[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1;
    }
    for (; i < larger.size_; ++i) {
      const Wide d = static_cast<Wide>(larger.limb_[i]) - borrow;
      r.limb_[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1;
    }
    r.size_ = i;
    r.trim();
    return r;
  }

  void trim() {
    while (size_ > 0 && limb_[size_ - 1] == 0) --size_;
  }

  int sign_ = 0;
  int size_ = 0;
  std::uint64_t limb_[Capacity];
};

}  // namespace carom
