#include "point/motions_in_digits.hpp"

namespace clatter::point {

template struct InDigits<FiftyDigits>;

}  // namespace clatter::point
