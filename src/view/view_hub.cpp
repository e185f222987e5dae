// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/view/view_hub.hpp"

#include <mutex>

#include "view/view_state.hpp"

namespace lio {

struct ViewHub::Impl {
  mutable std::mutex mutex;  // guards state
  ViewState state;
};

ViewHub::ViewHub() : impl_(std::make_unique<Impl>()) {}
ViewHub::~ViewHub() = default;

void ViewHub::Change(const std::function<void(ViewState&)>& change) {
  const std::lock_guard lock(impl_->mutex);
  change(impl_->state);
}

void ViewHub::Read(const std::function<void(const ViewState&)>& read) const {
  const std::lock_guard lock(impl_->mutex);
  read(impl_->state);
}

}  // namespace lio
