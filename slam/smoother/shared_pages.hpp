#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace azimuth {

/// A list that grows at its end. Copies share the pages that neither copy has changed since: a copy costs one pointer
/// per page of PageEntries entries, and the first change to a shared page copies that page.
///
/// Thread contract: thread-bound; two lists that share pages may be used on two threads once the copy has been handed
/// over.
template <class Entry, std::size_t PageEntries = 64>
class SharedPages {
 public:
  using Number = std::int32_t;  // index of an entry

  Number size() const { return size_; }
  bool empty() const { return size_ == 0; }

  const Entry& operator[](Number at) const {
    const auto place = static_cast<std::size_t>(at);
    return (*pages_[place / PageEntries])[place % PageEntries];
  }
  const Entry& back() const { return (*this)[size_ - 1]; }

  /// Returns the entry for a change; its page is no longer shared afterwards.
  Entry& edit(Number at) {
    const auto place = static_cast<std::size_t>(at);
    std::shared_ptr<Page>& page = pages_[place / PageEntries];
    if (page.use_count() > 1)
      page = std::make_shared<Page>(*page);
    else  // counting the pointer synchronises with another thread that has just released the page
        [[maybe_unused]]
      const std::shared_ptr<Page> alone = page;
    return (*page)[place % PageEntries];
  }

  void push_back(Entry entry) {
    if (static_cast<std::size_t>(size_) % PageEntries == 0) pages_.push_back(std::make_shared<Page>());
    edit(size_++) = std::move(entry);
  }

 private:
  using Page = std::array<Entry, PageEntries>;
  std::vector<std::shared_ptr<Page>> pages_;
  Number size_ = 0;
};

}  // namespace azimuth
