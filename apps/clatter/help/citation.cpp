#include "help/citation.hpp"

#include "results/version.hpp"

namespace clatter::app {

std::string citation() {
  return "@software{clatter,\n"
         "  title   = {clatter: exact sweeps of vibro-impact oscillators},\n"
         "  author  = {{The clatter authors}},\n"
         "  version = {" +
         std::string(results::version()) +
         "},\n"
         "  year    = {" +
         std::string(results::release_date().substr(0, 4)) +
         "}\n"
         "}\n\n"
         "@article{ragulskis2023,\n"
         "  title   = {Vibration Drives with Two Impacting Pairs for Precise Robots},\n"
         "  author  = {Ragulskis, K. and Ragulskis, L.},\n"
         "  journal = {Mechanika},\n"
         "  year    = {2023},\n"
         "  doi     = {10.5755/j02.mech.32277}\n"
         "}\n";
}

}  // namespace clatter::app
