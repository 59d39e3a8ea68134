/* The page's script and style as bytes, so that a report needs no file beside it. Each ends with a zero byte. */
        .section .rodata
        .global boresight_report_script
        .global boresight_report_script_end
        .global boresight_report_style
        .global boresight_report_style_end
boresight_report_script:
        .incbin REPORT_SCRIPT
boresight_report_script_end:
        .byte 0
boresight_report_style:
        .incbin REPORT_STYLE
boresight_report_style_end:
        .byte 0
        .section .note.GNU-stack,"",%progbits
