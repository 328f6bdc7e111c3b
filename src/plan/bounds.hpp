#pragma once

namespace clatter::plan {

/// The least and the greatest that something can come to.
struct Bounds {
  double least = 0.0, most = 0.0;

  Bounds& operator+=(const Bounds& other) {
    least += other.least, most += other.most;
    return *this;
  }
};

inline Bounds operator*(const Bounds& estimate, double factor) {
  return {estimate.least * factor, estimate.most * factor};
}

}  // namespace clatter::plan
