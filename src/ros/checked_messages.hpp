#pragma once

/// @file
/// Subscriptions and services whose messages are read with their lengths checked
/// (bounded_stream.hpp). What cannot be read goes to a function of the node's, which counts or
/// answers, in place of a line in roscpp's log.
///
/// A publisher in the same process still hands over its message without a copy.

#include <cstdint>
#include <functional>
#include <string>
#include <typeinfo>
#include <utility>

#include <ros/node_handle.h>
#include <ros/service_callback_helper.h>
#include <ros/subscription_callback_helper.h>
#include <boost/make_shared.hpp>

#include "errors/error_text.hpp"
#include "ros/bounded_stream.hpp"

namespace mems_stiction {

/// roscpp takes no larger message [bytes].
inline constexpr double kLargestMessage = 1e9;

/// @throw MessageError for a message of more than `most` bytes
inline void requireSize(std::uint64_t size, double most) {
  if (static_cast<double>(size) <= most) return;
  throw MessageError("the message has " + std::to_string(size) + " bytes, must have at most " +
                     std::to_string(static_cast<std::uint64_t>(most)) + " (max_message_size)");
}

/// What a subscription does with a message of this type.
template <typename Message>
struct MessageReceiver {
  std::function<void(const boost::shared_ptr<const Message>&)> take;
  std::function<void(const BoundedStream& bytes, const std::string& reason)> refuse;
  double max_bytes = kLargestMessage;
};

/// roscpp's door to a subscription of one's own.
template <typename Message>
class CheckedCallback : public ros::SubscriptionCallbackHelper {
 public:
  explicit CheckedCallback(MessageReceiver<Message> receiver) : receiver_(std::move(receiver)) {}

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    try {
      requireSize(params.length, receiver_.max_bytes);
      const auto message = boost::make_shared<Message>();
      readMessage(params.buffer, params.length, *message);
      return message;
    } catch (const std::exception& error) {
      receiver_.refuse(BoundedStream(params.buffer, params.length), reasonOf(error));
      return {};
    }
  }
  void call(ros::SubscriptionCallbackHelperCallParams& params) override {
    receiver_.take(boost::static_pointer_cast<const Message>(params.event.getConstMessage()));
  }
  const std::type_info& getTypeInfo() override { return typeid(Message); }
  bool isConst() override { return true; }
  bool hasHeader() override { return ros::message_traits::hasHeader<Message>(); }

 private:
  MessageReceiver<Message> receiver_;
};

template <typename Message>
ros::Subscriber subscribeChecked(ros::NodeHandle& handle, const std::string& topic,
                                 std::uint32_t queue_size, MessageReceiver<Message> receiver) {
  ros::SubscribeOptions options(topic, queue_size, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper = boost::make_shared<CheckedCallback<Message>>(std::move(receiver));
  return handle.subscribe(options);
}

/// What a service does with a request.
template <typename Service>
struct RequestReceiver {
  std::function<void(typename Service::Request&, typename Service::Response&)> answer;
  std::function<void(typename Service::Response&, const std::string& reason)> refuse;
  double max_bytes = kLargestMessage;
};

/// roscpp's door to a service of one's own.
template <typename Service>
class CheckedService : public ros::ServiceCallbackHelper {
 public:
  explicit CheckedService(RequestReceiver<Service> receiver) : receiver_(std::move(receiver)) {}

  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    typename Service::Response response;
    try {
      const auto before = params.request.message_start - params.request.buf.get();
      const std::size_t size = params.request.num_bytes - static_cast<std::size_t>(before);
      requireSize(size, receiver_.max_bytes);
      typename Service::Request request;
      readMessage(params.request.message_start, static_cast<std::uint32_t>(size), request);
      params.request = ros::SerializedMessage();  // its memory, too
      receiver_.answer(request, response);
    } catch (const std::exception& error) {
      receiver_.refuse(response, reasonOf(error));
    }
    params.response = ros::serialization::serializeServiceResponse(true, response);
    return true;
  }

 private:
  RequestReceiver<Service> receiver_;
};

template <typename Service>
ros::ServiceServer advertiseChecked(ros::NodeHandle& handle, const std::string& name,
                                    RequestReceiver<Service> receiver) {
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = ros::service_traits::md5sum<Service>();
  options.datatype = ros::service_traits::datatype<Service>();
  options.req_datatype = ros::message_traits::datatype<typename Service::Request>();
  options.res_datatype = ros::message_traits::datatype<typename Service::Response>();
  options.helper = boost::make_shared<CheckedService<Service>>(std::move(receiver));
  return handle.advertiseService(options);
}

}  // namespace mems_stiction
