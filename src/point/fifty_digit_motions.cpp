#include "point/motions_in_digits.hpp"

namespace clatter::point {

template struct InDigits<WideFloat>;

}  // namespace clatter::point
