#pragma once
#include <tamis/core/config.hpp>

#include <utility>

namespace tamis::detail {

template <class F, class... Arguments> void call_as(const void* f, Arguments... arguments) {
    (*static_cast<const F*>(f))(arguments...);
}

/// Something that can be called with these arguments, by reference: what calls it is compiled once for all.
template <class... Arguments> class call_ref {
  public:
    template <class F> static call_ref to(const F& f) { return {&f, call_as<F, Arguments...>}; }
    call_ref(const void* object, void (*call)(const void*, Arguments...)) : object_(object), call_(call) {}
    void operator()(Arguments... arguments) const { call_(object_, arguments...); }

  private:
    const void* object_;
    void (*call_)(const void*, Arguments...);
};

/// ... kept for later. As std::move_only_function of C++23, of which it has what is needed here; what is called by
/// reference and what is kept share their code.
template <class... Arguments> class any_call {
  public:
    template <class F> explicit any_call(F f)
        : object_(new F(std::move(f))),
          call_(call_as<F, Arguments...>),
          destroy_([](void* object) { delete static_cast<F*>(object); }) {}
    any_call(any_call&& other) noexcept
        : object_(std::exchange(other.object_, nullptr)), call_(other.call_), destroy_(other.destroy_) {}
    any_call& operator=(any_call&&) = delete;
    ~any_call() {
        if (object_ != nullptr) destroy_(object_);
    }
    call_ref<Arguments...> ref() const { return {object_, call_}; }
    void operator()(Arguments... arguments) const { call_(object_, arguments...); }

  private:
    void* object_;
    void (*call_)(const void*, Arguments...);
    void (*destroy_)(void*);
};

}  // namespace tamis::detail
