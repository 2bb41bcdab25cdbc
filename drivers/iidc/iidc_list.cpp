#include "drivers/iidc/iidc_list.hpp"

#include <algorithm>
#include <span>

#include "drivers/iidc/iidc_camera.hpp"
#include "drivers/iidc/iidc_text.hpp"

namespace azimuth {

IidcBus list_iidc_cameras() {
  iidc::silence_library();
  iidc::take_complaint();
  const std::unique_ptr<dc1394_t, iidc::FreeContext> context(dc1394_new());
  if (!context) return {.trouble = "libdc1394 finds neither FireWire nor USB"};
  dc1394camera_list_t* found = nullptr;
  const dc1394error_t error = dc1394_camera_enumerate(context.get(), &found);
  const std::unique_ptr<dc1394camera_list_t, iidc::FreeList> list(found);
  if (error != DC1394_SUCCESS || !list) {
    iidc::OpenCamera any;
    any.guid = "(any)";
    return {.trouble = iidc::trouble_of(any, "enumerating the bus", error).text};
  }
  IidcBus bus{.trouble = iidc::take_complaint()};
  for (const dc1394camera_id_t& id : std::span(list->ids, list->num)) bus.guids.push_back(iidc::guid_text(id.guid));
  std::ranges::sort(bus.guids);
  return bus;
}

}  // namespace azimuth
