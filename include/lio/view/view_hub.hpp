// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Stands between the thread that hears messages and the one that serves pages.
#pragma once

#include <functional>
#include <memory>

namespace lio {

class ViewState;

class ViewHub {
 public:
  ViewHub();
  ~ViewHub();
  ViewHub(const ViewHub&) = delete;
  ViewHub& operator=(const ViewHub&) = delete;

  // The function must be short: the other thread waits for it meanwhile.
  void Change(const std::function<void(ViewState&)>& change);
  void Read(const std::function<void(const ViewState&)>& read) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lio
