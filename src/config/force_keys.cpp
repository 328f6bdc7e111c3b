#include "config/force_keys.hpp"

#include "scene/force_shape.hpp"
#include "scene/parameter.hpp"

namespace clatter::config {

Key force_shape_key(bool is_si) {
  Key key = one_of(force_shapes,
                   Key{is_si ? "machine" : "scene", "force_shape", Kind::choice, "sine", "square",
                       "course of the force over its period. square: f, then -f; pulse: f, then 0; triangle: straight "
                       "lines between the zeros and peaks of the sine; trapezoid: steeper ones, cut at the peaks; "
                       "sawtooth: a straight line from -f to f; half-sine: one half wave, then 0"});
  key.beside = (is_si ? Parameter("phase").row().in_machine : Parameter("phase").row().in_scene).beside;
  return key;
}

Key force_table_key(bool is_si) {
  Key key{
      is_si ? "machine" : "scene",
      "force_table",
      Kind::text,
      "",
      "period, f; 0, 1; 0.5, -1; 1, 1",
      "one period of the force as measured, in place of f and force_shape: a CSV file, or its rows with semicolons "
      "between; above them tau, phase (deg), phase (rad) or period, its share, and f. Straight lines between rows, "
      "of which the first has the phase 0, and the last closes the period, which is stretched to that of nu; two at "
      "one time are a jump. A name counts from the configuration, after --set from the working directory"};
  key.other = "f";
  if (is_si) {
    key.example = "time (ms), force (N); 0, 40; 20, -40; 40, 40";
    key.help =
        "one period of the force as measured, in place of force and force_shape: a CSV file, or its rows with "
        "semicolons between; above them time (ms) or another unit, phase (deg), phase (rad) or period, its share, and "
        "force (N). Straight lines between rows, of which the first has the phase 0, and the last closes the "
        "period, which is stretched to that of the frequency; two at one time are a jump. A name counts from the "
        "configuration, after --set from the working directory";
    key.other = "force";
    key.beside = "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nfrequency = 25.0\n";
  }
  return key;
}

Key force_table_harmonics_key(bool is_si) {
  Key key{
      is_si ? "machine" : "scene",
      "force_table_harmonics",
      Kind::integer,
      "0",
      "3",
      "take the mean and so many orders of the force of force_table, by the integrals of its straight lines, in place "
      "of the lines; 0: the lines",
      AllowedRange{.low = 0, .high = 8}};
  key.beside = is_si ? "mass = 0.25\nstiffness = 800.0\ngap = 3e-3\nfrequency = 25.0\n"
                       "force_table = \"period, force (N); 0, 40; 0.5, -40; 1, 40\"\n"
                     : "force_table = \"period, f; 0, 1; 0.5, -1; 1, 1\"\n";
  return key;
}

}  // namespace clatter::config
