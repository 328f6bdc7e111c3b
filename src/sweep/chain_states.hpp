#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "storage/scratch.hpp"

namespace clatter::sweep {

/// Which chains of a run are finished, and which of these are saved, a bit each. Threads may use it at the same time.
class ChainStates {
 public:
  /// Throws std::bad_alloc, storage::IoError.
  ChainStates(std::size_t chains, storage::Scratch& scratch)
      : bits_(scratch.region(2 * words_for(chains) * sizeof(Word))),
        finished_(bits_->as<Word>().first(words_for(chains))),
        saved_(bits_->as<Word>().last(words_for(chains))) {}

  [[nodiscard]] bool is_finished(std::size_t chain) const { return has(finished_, chain); }
  [[nodiscard]] bool is_saved(std::size_t chain) const { return has(saved_, chain); }
  /// Its results are stored.
  void finish(std::size_t chain) { set(finished_, chain); }
  /// They are in the journal as well.
  void save(std::size_t chain) { set(finished_, chain), set(saved_, chain); }

  /// Calls `take(chain)` for each chain that is finished and not saved, in their order.
  template <class Take>
  void each_unsaved(const Take& take) const {
    for (std::size_t i = 0; i < finished_.size(); ++i)
      for (Word left = load(finished_[i]) & ~load(saved_[i]); left != 0; left &= left - 1)
        take(i * bits_of_word + static_cast<std::size_t>(std::countr_zero(left)));
  }

 private:
  using Word = std::uint64_t;
  static constexpr std::size_t bits_of_word = 64;

  static std::size_t words_for(std::size_t chains) { return (chains + bits_of_word - 1) / bits_of_word; }
  static Word load(Word& word) { return std::atomic_ref(word).load(std::memory_order_acquire); }
  static bool has(std::span<Word> words, std::size_t chain) {
    return (load(words[chain / bits_of_word]) >> chain % bits_of_word & 1U) != 0;
  }
  static void set(std::span<Word> words, std::size_t chain) {
    std::atomic_ref(words[chain / bits_of_word]).fetch_or(Word{1} << chain % bits_of_word, std::memory_order_release);
  }

  std::shared_ptr<const storage::Region> bits_;
  std::span<Word> finished_, saved_;
};

}  // namespace clatter::sweep
