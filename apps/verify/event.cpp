#include "event.hpp"

namespace verify {

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::impact:
      return "impact";
    case Kind::touch:
      return "touch";
    case Kind::separation:
      return "separation";
    case Kind::renewal:
      return "renewal";
    case Kind::graze:
      return "graze";
    case Kind::chatter:
      return "chatter";
    case Kind::rest:
      return "rest";
    case Kind::reversal:
      return "reversal";
    case Kind::stick:
      return "stick";
    case Kind::turn:
      return "turn";
    case Kind::hold:
      return "hold";
    case Kind::press:
      return "press";
    default:
      return "end";
  }
}

}  // namespace verify
