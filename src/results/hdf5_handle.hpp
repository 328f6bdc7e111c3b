#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <utility>

namespace clatter::results::detail {

/// A file that the HDF5 library cannot read or write; `what()` is the reason.
class Failure : public std::runtime_error {
 public:
  /// Takes the reason from the error stack of this thread.
  Failure();
  using std::runtime_error::runtime_error;
};

/// Returns the result of an HDF5 call; throws if it is negative, which means failure for every type that the library
/// returns.
template <typename Result>
Result checked(Result result) {
  if (result < 0) throw Failure{};
  return result;
}

/// Keeps the library from printing its error stack, which becomes a Failure instead, and from cleaning up at exit,
/// where it would complain of objects in a damaged file that it could not close.
class QuietErrors {
 public:
  QuietErrors() {
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &stream_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, stream_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* stream_ = nullptr;
};

/// Owns an HDF5 identifier, so that an exception doesn't leave it, and with it its file, open.
class Handle {
 public:
  /// `id` is the result of the call that opened it, `close` the call that closes such an object.
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_{checked(id)}, close_{close} {}
  Handle(Handle&& other) noexcept : id_{std::exchange(other.id_, H5I_INVALID_HID)}, close_{other.close_} {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): stands for the identifier in C calls

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

}  // namespace clatter::results::detail
