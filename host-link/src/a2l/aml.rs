//! The language of the interface parts (A2ML): the blocks that are written here, in the form, with the tags and with
//! the enumeration names of the ASAM standard. A tool that has its own copy of the standard's language reads the file
//! with that.

/// The block A2ML.
pub(super) const A2ML: &str = r#"/begin A2ML
struct Protocol_Layer {
  uint; /* version of the protocol layer */
  uint; uint; uint; uint; uint; uint; uint; /* T1 to T7, ms */
  uchar; /* MAX_CTO */
  uint; /* MAX_DTO */
  enum { "BYTE_ORDER_MSB_LAST" = 0, "BYTE_ORDER_MSB_FIRST" = 1 };
  enum { "ADDRESS_GRANULARITY_BYTE" = 1, "ADDRESS_GRANULARITY_WORD" = 2, "ADDRESS_GRANULARITY_DWORD" = 4 };
  taggedstruct {
    ("OPTIONAL_CMD" enum {
      "GET_COMM_MODE_INFO" = 0xFB, "GET_ID" = 0xFA, "SET_REQUEST" = 0xF9, "GET_SEED" = 0xF8, "UNLOCK" = 0xF7,
      "SET_MTA" = 0xF6, "UPLOAD" = 0xF5, "SHORT_UPLOAD" = 0xF4, "BUILD_CHECKSUM" = 0xF3,
      "TRANSPORT_LAYER_CMD" = 0xF2, "USER_CMD" = 0xF1, "DOWNLOAD" = 0xF0, "DOWNLOAD_NEXT" = 0xEF,
      "DOWNLOAD_MAX" = 0xEE, "SHORT_DOWNLOAD" = 0xED, "MODIFY_BITS" = 0xEC, "SET_CAL_PAGE" = 0xEB,
      "GET_CAL_PAGE" = 0xEA, "GET_PAG_PROCESSOR_INFO" = 0xE9, "GET_SEGMENT_INFO" = 0xE8, "GET_PAGE_INFO" = 0xE7,
      "SET_SEGMENT_MODE" = 0xE6, "GET_SEGMENT_MODE" = 0xE5, "COPY_CAL_PAGE" = 0xE4, "CLEAR_DAQ_LIST" = 0xE3,
      "SET_DAQ_PTR" = 0xE2, "WRITE_DAQ" = 0xE1, "SET_DAQ_LIST_MODE" = 0xE0, "GET_DAQ_LIST_MODE" = 0xDF,
      "START_STOP_DAQ_LIST" = 0xDE, "START_STOP_SYNCH" = 0xDD, "GET_DAQ_CLOCK" = 0xDC, "READ_DAQ" = 0xDB,
      "GET_DAQ_PROCESSOR_INFO" = 0xDA, "GET_DAQ_RESOLUTION_INFO" = 0xD9, "GET_DAQ_LIST_INFO" = 0xD8,
      "GET_DAQ_EVENT_INFO" = 0xD7, "FREE_DAQ" = 0xD6, "ALLOC_DAQ" = 0xD5, "ALLOC_ODT" = 0xD4,
      "ALLOC_ODT_ENTRY" = 0xD3, "PROGRAM_START" = 0xD2, "PROGRAM_CLEAR" = 0xD1, "PROGRAM" = 0xD0,
      "PROGRAM_RESET" = 0xCF, "GET_PGM_PROCESSOR_INFO" = 0xCE, "GET_SECTOR_INFO" = 0xCD, "PROGRAM_PREPARE" = 0xCC,
      "PROGRAM_FORMAT" = 0xCB, "PROGRAM_NEXT" = 0xCA, "PROGRAM_MAX" = 0xC9, "PROGRAM_VERIFY" = 0xC8,
      "WRITE_DAQ_MULTIPLE" = 0xC7
    })*;
  };
};
struct Daq {
  enum { "STATIC" = 0, "DYNAMIC" = 1 };
  uint; /* MAX_DAQ */
  uint; /* MAX_EVENT_CHANNEL */
  uchar; /* MIN_DAQ */
  enum {
    "OPTIMISATION_TYPE_DEFAULT" = 0, "OPTIMISATION_TYPE_ODT_TYPE_16" = 1, "OPTIMISATION_TYPE_ODT_TYPE_32" = 2,
    "OPTIMISATION_TYPE_ODT_TYPE_64" = 3, "OPTIMISATION_TYPE_ODT_TYPE_ALIGNMENT" = 4,
    "OPTIMISATION_TYPE_MAX_ENTRY_SIZE" = 5
  };
  enum { "ADDRESS_EXTENSION_FREE" = 0, "ADDRESS_EXTENSION_ODT" = 1, "ADDRESS_EXTENSION_DAQ" = 3 };
  enum {
    "IDENTIFICATION_FIELD_TYPE_ABSOLUTE" = 0, "IDENTIFICATION_FIELD_TYPE_RELATIVE_BYTE" = 1,
    "IDENTIFICATION_FIELD_TYPE_RELATIVE_WORD" = 2, "IDENTIFICATION_FIELD_TYPE_RELATIVE_WORD_ALIGNED" = 3
  };
  enum {
    "GRANULARITY_ODT_ENTRY_SIZE_DAQ_BYTE" = 1, "GRANULARITY_ODT_ENTRY_SIZE_DAQ_WORD" = 2,
    "GRANULARITY_ODT_ENTRY_SIZE_DAQ_DWORD" = 4, "GRANULARITY_ODT_ENTRY_SIZE_DAQ_DLONG" = 8
  };
  uchar; /* MAX_ODT_ENTRY_SIZE_DAQ */
  enum { "NO_OVERLOAD_INDICATION" = 0, "OVERLOAD_INDICATION_PID" = 1, "OVERLOAD_INDICATION_EVENT" = 2 };
  taggedstruct {
    "PRESCALER_SUPPORTED";
    "RESUME_SUPPORTED";
    block "TIMESTAMP_SUPPORTED" struct {
      uint; /* TIMESTAMP_TICKS */
      enum { "NO_TIME_STAMP" = 0, "SIZE_BYTE" = 1, "SIZE_WORD" = 2, "SIZE_DWORD" = 4 };
      enum {
        "UNIT_1NS" = 0, "UNIT_10NS" = 1, "UNIT_100NS" = 2, "UNIT_1US" = 3, "UNIT_10US" = 4, "UNIT_100US" = 5,
        "UNIT_1MS" = 6, "UNIT_10MS" = 7, "UNIT_100MS" = 8, "UNIT_1S" = 9
      };
      taggedstruct { "TIMESTAMP_FIXED"; };
    };
    (block "EVENT" struct {
      char[101]; /* EVENT_CHANNEL_NAME */
      char[9]; /* EVENT_CHANNEL_SHORT_NAME */
      uint; /* EVENT_CHANNEL_NUMBER */
      enum { "DAQ" = 1, "STIM" = 2, "DAQ_STIM" = 3 };
      uchar; /* MAX_DAQ_LIST */
      uchar; /* EVENT_CHANNEL_TIME_CYCLE */
      uchar; /* EVENT_CHANNEL_TIME_UNIT */
      uchar; /* EVENT_CHANNEL_PRIORITY */
      taggedstruct {
        "COMPLEMENTARY_BYPASS_EVENT_CHANNEL_NUMBER" uint;
        "CONSISTENCY" enum { "DAQ" = 0, "EVENT" = 1 };
      };
    })*;
  };
};
taggedunion Daq_Event {
  "FIXED_EVENT_LIST" taggedstruct { ("EVENT" uint)*; };
  "VARIABLE" taggedstruct {
    block "AVAILABLE_EVENT_LIST" taggedstruct { ("EVENT" uint)*; };
    block "DEFAULT_EVENT_LIST" taggedstruct { ("EVENT" uint)*; };
  };
};
struct Pag {
  uchar; /* MAX_SEGMENTS */
  taggedstruct { "FREEZE_SUPPORTED"; };
};
struct Segment {
  uchar; /* SEGMENT_NUMBER */
  uchar; /* number of pages */
  uchar; /* ADDRESS_EXTENSION */
  uchar; /* COMPRESSION_METHOD */
  uchar; /* ENCRYPTION_METHOD */
  taggedstruct {
    block "CHECKSUM" struct {
      enum {
        "XCP_ADD_11" = 1, "XCP_ADD_12" = 2, "XCP_ADD_14" = 3, "XCP_ADD_22" = 4, "XCP_ADD_24" = 5, "XCP_ADD_44" = 6,
        "XCP_CRC_16" = 7, "XCP_CRC_16_CITT" = 8, "XCP_CRC_32" = 9, "XCP_USER_DEFINED" = 255
      };
      taggedstruct { "MAX_BLOCK_SIZE" ulong; "EXTERNAL_FUNCTION" char[256]; };
    };
    (block "PAGE" struct {
      uchar; /* PAGE_NUMBER */
      enum {
        "ECU_ACCESS_NOT_ALLOWED" = 0, "ECU_ACCESS_WITHOUT_XCP_ONLY" = 1, "ECU_ACCESS_WITH_XCP_ONLY" = 2,
        "ECU_ACCESS_DONT_CARE" = 3
      };
      enum {
        "XCP_READ_ACCESS_NOT_ALLOWED" = 0, "XCP_READ_ACCESS_WITHOUT_ECU_ONLY" = 1,
        "XCP_READ_ACCESS_WITH_ECU_ONLY" = 2, "XCP_READ_ACCESS_DONT_CARE" = 3
      };
      enum {
        "XCP_WRITE_ACCESS_NOT_ALLOWED" = 0, "XCP_WRITE_ACCESS_WITHOUT_ECU_ONLY" = 1,
        "XCP_WRITE_ACCESS_WITH_ECU_ONLY" = 2, "XCP_WRITE_ACCESS_DONT_CARE" = 3
      };
      taggedstruct { "INIT_SEGMENT" uchar; };
    })*;
  };
};
taggedstruct Common_Parameters {
  block "PROTOCOL_LAYER" struct Protocol_Layer;
  block "SEGMENT" struct Segment;
  block "DAQ" struct Daq;
  block "PAG" struct Pag;
  block "DAQ_EVENT" taggedunion Daq_Event;
};
struct Ip_Parameters {
  uint; /* version of the transport layer */
  uint; /* PORT */
  taggedunion { "HOST_NAME" char[256]; "ADDRESS" char[15]; "IPV6" char[39]; };
};
block "IF_DATA" taggedunion if_data {
  "XCP" struct {
    taggedstruct Common_Parameters;
    taggedstruct {
      block "XCP_ON_TCP_IP" struct {
        struct Ip_Parameters;
        taggedstruct Common_Parameters;
      };
      block "XCP_ON_UDP_IP" struct {
        struct Ip_Parameters;
        taggedstruct Common_Parameters;
      };
    };
  };
};
/end A2ML
"#;
